#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes what Java and C say to each other: generate.py FUNCTIONS_PY NODES_H FOLDER.

From the table of controller/functions.py come Native.java, a native method for each function, and natives.inc, what
JNI calls; from webots/nodes.h comes Kinds.java, the constants of Node. native.c has the rest.
"""
import os
import re
import runpy
import sys

FUNCTIONS_PY, NODES_H, FOLDER = sys.argv[1:]
FUNCTIONS = runpy.run_path(FUNCTIONS_PY)["FUNCTIONS"]
PACKAGE = "com.cyberbotics.webots.controller"

JAVA = {"v": "void", "i": "int", "t": "int", "l": "long", "b": "boolean", "d": "double", "s": "String", "p": "long",
        "B": "byte[]", "D": "double[]", "I": "int[]"}
SIGNATURE = {"v": "V", "i": "I", "t": "I", "l": "J", "b": "Z", "d": "D", "s": "Ljava/lang/String;", "p": "J",
             "B": "[B", "D": "[D", "I": "[I"}
C = {"v": "void", "i": "jint", "t": "jint", "l": "jlong", "b": "jboolean", "d": "jdouble", "s": "jstring", "p": "jlong",
     "B": "jbyteArray", "D": "jdoubleArray", "I": "jintArray"}
# taken before the call, passed to it, given back after it
TAKE = {"s": "  const char* c{0} = text_of(env, a{0});\n",
        "B": "  jbyte* c{0} = a{0} ? (*env)->GetByteArrayElements(env, a{0}, 0) : 0;\n",
        "D": "  jdouble* c{0} = a{0} ? (*env)->GetDoubleArrayElements(env, a{0}, 0) : 0;\n",
        "I": "  jint* c{0} = a{0} ? (*env)->GetIntArrayElements(env, a{0}, 0) : 0;\n"}
PASS = {"t": "(WbDeviceTag)a{0}", "b": "a{0} != 0", "p": "(void*)(intptr_t)a{0}", "s": "c{0}", "B": "c{0}", "D": "c{0}",
        "I": "(const int*)c{0}"}
GIVE = {"s": "  if (c{0}) free((void*)c{0});\n",
        "B": "  if (c{0}) (*env)->ReleaseByteArrayElements(env, a{0}, c{0}, JNI_ABORT);\n",
        "D": "  if (c{0}) (*env)->ReleaseDoubleArrayElements(env, a{0}, c{0}, JNI_ABORT);\n",
        "I": "  if (c{0}) (*env)->ReleaseIntArrayElements(env, a{0}, c{0}, JNI_ABORT);\n"}


def of_java(name, result, arguments):
    # one thread at a time is in the library, but for the one that waits
    alone = "" if name == "twinpuck_wait" else "synchronized "
    words = ", ".join("%s a%d" % (JAVA[a], i) for i, a in enumerate(arguments))
    return "  static %snative %s %s(%s);\n" % (alone, JAVA["p" if result == "D" else result], name, words)


def of_c(name, result, arguments):
    kind = "p" if result == "D" else result
    head = "".join(", %s a%d" % (C[a], i) for i, a in enumerate(arguments))
    call = "%s(%s)" % (name if name.startswith("twinpuck_") else "wb_" + name,
                       ", ".join(PASS.get(a, "a{0}").format(i) for i, a in enumerate(arguments)))
    lines = "static %s JNICALL n_%s(JNIEnv* env, jclass self%s) {\n  (void)env, (void)self;\n" % (C[kind], name, head)
    lines += "".join(TAKE.get(a, "").format(i) for i, a in enumerate(arguments))
    if result == "v":
        lines += "  %s;\n" % call
    elif result == "s":
        lines += "  jstring result = text_for(env, %s);\n" % call
    elif kind == "p":
        lines += "  jlong result = (jlong)(intptr_t)%s;\n" % call
    else:
        lines += "  %s result = (%s)%s;\n" % (C[kind], C[kind], call)
    lines += "".join(GIVE.get(a, "").format(i) for i, a in enumerate(arguments))
    return lines + ("}\n" if result == "v" else "  return result;\n}\n")


def of_table(name, result, arguments):
    signature = "(%s)%s" % ("".join(SIGNATURE[a] for a in arguments), SIGNATURE["p" if result == "D" else result])
    return '    {"%s", "%s", (void*)n_%s},\n' % (name, signature, name)


def write(name, text):
    with open(os.path.join(FOLDER, name), "w", encoding="utf-8") as file:
        file.write(text)


functions = [(name, result, arguments) for name, (result, arguments) in FUNCTIONS.items()
             if name != "supervisor_node_get_contact_points"]  # which native.c has in Java's way
write("Native.java", "package %s;\n\n/** The functions of libcontroller.so. Made by generate.py. */\nfinal class Native extends Memory {\n%s}\n" %
      (PACKAGE, "".join(of_java(*f) for f in functions)))
write("natives.inc", "\n".join(of_c(*f) for f in functions) +
      "\nstatic const JNINativeMethod kNatives[] = {\n" + "".join(of_table(*f) for f in functions) + "};\n")

kinds = re.findall(r"^\s*WB_NODE_(\w+),?$", re.search(r"enum \{(.*?)\}", open(NODES_H, encoding="utf-8").read(), re.S)[1], re.M)
write("Kinds.java", "package %s;\n\n/** Kinds of nodes, as webots/nodes.h numbers them. Made by generate.py. */\ninterface Kinds {\n%s}\n" %
      (PACKAGE, "".join("  int %s = %d;\n" % (kind, i) for i, kind in enumerate(kinds))))
