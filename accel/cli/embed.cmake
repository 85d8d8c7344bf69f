# SPDX-License-Identifier: Apache-2.0
# Writes C that holds files: run as  cmake -DFILES=a;b -DOUTPUT=files.c -P embed.cmake
set(code "/* Made by embed.cmake. */\n#include \"report/report_text.h\"\n\n#include <stddef.h>\n\n")
set(table "")
foreach(file ${FILES})
    get_filename_component(name ${file} NAME)
    string(MAKE_C_IDENTIFIER ${name} symbol)
    file(READ ${file} bytes HEX)
    string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
    string(APPEND code "static const unsigned char ${symbol}[] = {${bytes}0};\n")
    string(APPEND table "    {\"${name}\", ${symbol}},\n")
endforeach()
file(WRITE ${OUTPUT} "${code}\nconst struct report_text report_texts[] = {\n${table}    {NULL, NULL},\n};\n")
