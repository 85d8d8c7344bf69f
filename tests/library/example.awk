# SPDX-License-Identifier: Apache-2.0
# Prints example number `n` of a text: of a C header, the n-th run of lines that are indented within
# a comment; of Markdown, the n-th block of C.
/^ \*     / {
    block += !inside
    inside = 1
    if (block == n)
        print blank substr($0, 8)
    blank = ""
    next
}
/^ \*$/ && inside {
    blank = blank "\n"
    next
}
/^```c$/ {
    block++
    fenced = 1
    next
}
/^```/ {
    fenced = 0
}
fenced && block == n
{
    inside = 0
    blank = ""
}
END {
    exit block < n
}
