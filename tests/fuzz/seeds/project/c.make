C_SOURCES = main.c ../lib/a.c $(wildcard *.c)
VPATH = .:../lib
CFLAGS += -I../inc -DX=1 -std=c99
include $(WEBOTS_HOME)/resources/Makefile.include
