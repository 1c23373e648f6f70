# Lets gdb see firmware, which the simulator puts into memory itself (file and address are the two arguments):
#   gdb -x scripts/firmware.gdb -ex 'break main.c:63' -ex run --args build/twinpuck run worlds/maze.toml
set breakpoint pending on
set confirm off
break *twinpuck_image_loaded
commands
silent
eval "add-symbol-file %s -o %p", (char*)$rdi, (void*)$rsi
continue
end
