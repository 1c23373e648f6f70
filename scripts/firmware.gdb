# Lets gdb see firmware, which the simulator puts into memory itself (file and address are the two arguments).
# `twinpuck debug --gdb` uses it; by hand:
#   gdb -x scripts/firmware.gdb -ex 'break main.c:63' -ex run --args build/twinpuck run worlds/maze.toml
set breakpoint pending on
set confirm off
set print inferior-events off
set print thread-events off
python
def stop_at_main(file):
    firmware = gdb.lookup_objfile(file)
    main = firmware.lookup_global_symbol("main") or firmware.lookup_static_symbol("main")
    if main:
        gdb.Breakpoint("*%d" % int(main.value().address), temporary=True)
end
break *twinpuck_image_loaded
commands
silent
eval "add-symbol-file %s -o %p", (char*)$rdi, (void*)$rsi
if !$_isvoid($stops_at_main)
python stop_at_main(gdb.parse_and_eval("(char*)$rdi").string())
end
continue
end
