#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# -o and --csv from outside: what is kept of a file, where links and descriptors lead, signals, full
# disks, size limits; as an ordinary user too where this runs as root. outputs.c has the same with
# faults inside.
root=$(realpath "$(dirname "$0")/../..")
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >one.obj
echo "0 0 4 0.1 0.1 -1" >rays.txt
expect 0 export one.obj -o whole
[ "$(stat -c %a whole)" = 644 ] || fail "a new file has the mode $(stat -c %a whole), not that of the umask"

# holds FILE: it has the whole export and nothing else.
holds() {
    cmp -s whole "$1" || fail "$1 holds not what was exported: ${2:-}"
}

# no_temporary [FOLDER]: nothing with six letters behind a dot is left.
no_temporary() {
    ! compgen -G "${1:-.}/*.??????" >/dev/null ||
        fail "left behind: $(compgen -G "${1:-.}/*.??????") ${2:-}"
}

# --------------------------------------------------------------- what is kept of a file ----

for mode in 600 640 755; do
    echo old >kept && chmod $mode kept
    expect 0 export one.obj -o kept
    holds kept
    [ "$(stat -c %a kept)" = $mode ] || fail "a file of mode $mode has now $(stat -c %a kept)"
done
(umask 077 && expect 0 export one.obj -o private && exit "$failures") || fail "umask 077"
[ "$(stat -c %a private)" = 600 ] || fail "a new file under umask 077 has $(stat -c %a private)"

for old in "" "$(head -c 5000 /dev/zero | tr '\0' x)"; do
    printf %s "$old" >first && ln -f first second
    expect 0 export one.obj -o first
    holds first "$old" && holds second "$old"
    [ first -ef second ] || fail "hard links are split"
done

mkdir sub
echo old >sub/target && ln -s sub/target near && ln -s near far && ln -s ../new sub/away
expect 0 export one.obj -o far
holds sub/target
expect 0 export one.obj -o sub/away
holds new
[ -L far ] && [ -L near ] && [ -L sub/away ] || fail "a link is gone"
rm new
expect 0 export one.obj -o "$PWD/sub/away"
holds new
ln -s round about && ln -s about round
complains "Too many levels of symbolic links" export one.obj -o round
ln -s sub linked && complains "it is a directory" export one.obj -o linked
complains "it is a directory" export one.obj -o sub/
complains "the name is empty" export one.obj -o ""
: >plain && complains "Not a directory" export one.obj -o plain/

# What is written goes by the name that was given, not by that of the file behind the link.
: >pixels && ln -s pixels view.png
expect 0 trace one -o view.png --size 4x4
[ "$(head -c 4 pixels | tail -c 3)" = PNG ] || fail "a link in .png got no PNG"

# ------------------------------------------------------------------------ descriptors ----

for name in - /dev/stdout /dev/fd/1 /proc/self/fd/1 /proc/thread-self/fd/1 stdout.inc /dev/fd/7; do
    ln -sf /dev/stdout stdout.inc
    for redirection in append overwrite middle; do
        printf 'before\n' >log
        case $redirection in
        append)
            exec 7>>log
            printf 'before\n' | cat - whole >wanted
            ;;
        overwrite)
            exec 7>log
            cp whole wanted
            ;;
        middle)
            exec 7<>log
            { echo before; } >&7
            printf 'before\n' | cat - whole >wanted
            ;;
        esac
        "$accel" export one.obj -o $name >&7 2>err || fail "-o $name: $(cat err)"
        echo after >&7
        echo after >>wanted
        exec 7>&-
        cmp -s log wanted || fail "-o $name to $redirection gives $(head -c 60 log)"
    done
done
"$accel" export one.obj -o - | cmp -s - whole || fail "-o - to a pipe"
"$accel" export one.obj -o /dev/stderr 2>&1 >/dev/null | cmp -s - whole || fail "-o /dev/stderr"
[ ! -e - ] || fail "-o - makes a file"
"$accel" trace one --rays rays.txt -o - >hits && [ -s hits ] || fail "trace --rays -o -"
"$accel" lazy one -a hoo --rays 10 --repeats 1 --csv - >both 2>err || grep -q hoo err
[ ! -s both ] || tail -n 1 both | grep -q '^"one","hoo",10,' || fail "lazy --csv -: $(tail -n 1 both)"
complains "neither .exr nor .png" trace one -o -
complains "does not end in .png" diff a.exr b.exr -o -
complains "neither .exr nor .png" photons one -o -
complains "Bad file descriptor" export one.obj -o /dev/fd/9
complains "only open to be read" export one.obj -o /dev/fd/0
got=0
"$accel" export one.obj -o - >&- 2>err || got=$?
[ $got = 2 ] && grep -q "it is closed" err || fail "-o - without standard output: $got, $(cat err)"
expect 0 export one.obj -o ./-
holds ./-

# Of a run that fails nothing is appended.
echo before >log
echo "no ray" | cat rays.txt - >bad.txt
"$accel" trace one --rays bad.txt -o - >>log 2>err && fail "a bad ray is no failure"
[ "$(cat log)" = before ] || fail "a failed run appends to its output"

mkfifo pipe pipe.exr
cat pipe >got &
expect 0 export one.obj -o pipe
wait $!
holds got
[ -p pipe ] || fail "a pipe is replaced"
cat pipe.exr >got &
expect 0 trace one -o pipe.exr --size 4x4
wait $!
expect 0 trace one -o file.exr --size 4x4
cmp -s got file.exr || fail "an EXR through a pipe is another one"
expect 0 export one.obj -o /dev/null
[ -c /dev/null ] || fail "/dev/null is replaced"
no_temporary

# ----------------------------------------------------------------------------- signals ----

# No core is left, and no sanitizer takes a signal for itself.
ulimit -c 0
export {A,T,M,UB}SAN_OPTIONS=handle_segv=0:handle_sigbus=0:handle_sigfpe=0:handle_abort=0:handle_sigill=0
# start TARGET: a long run in the background, of which the temporary file is there already.
start() {
    env --default-signal=HUP,INT,QUIT "$accel" trace teapots -o "$1" --size 3000x3000 -t 1 -q &
    pid=$!
    for ((i = 0; i < 200; i++)); do
        ! compgen -G "$1.??????" >/dev/null || break
        sleep 0.05
    done
}
echo old >old.png
for signal in HUP INT QUIT ILL ABRT FPE SEGV PIPE ALRM TERM USR1 USR2 XCPU XFSZ VTALRM PROF SYS PWR RTMIN; do
    for target in old.png new.png; do
        start $target
        kill -$signal "$pid"
        got=0
        wait "$pid" 2>/dev/null || got=$?
        [ "$got" = $((128 + $(kill -l $signal))) ] || fail "$signal: status $got"
        no_temporary . "by $signal"
        rm -f ./*.png.??????
    done
done
[ "$(cat old.png)" = old ] && [ ! -e new.png ] || fail "a signal changes the output"

# What is ignored stays so, as nohup wants it.
for signal in HUP INT XCPU USR1; do
    got=0
    (
        trap '' $signal
        exec "$accel" trace teapots -o ignored.png --size 300x300 -t 1 -q
    ) &
    pid=$!
    for ((i = 0; i < 200; i++)); do
        ! compgen -G "ignored.png.??????" >/dev/null || break
        sleep 0.05
    done
    kill -$signal "$pid"
    wait "$pid" || got=$?
    [ "$got" = 0 ] && [ -s ignored.png ] || fail "$signal was ignored, and yet the status is $got"
    rm -f ignored.png
done

# ------------------------------------------------------------ size limits, full disks ----

# A limit of 1024 bytes: as a signal it ends the run, ignored it is named; nothing changes.
for name in kept first - ; do
    for ignored in yes no; do
        head -c 1000 /dev/zero | tr '\0' o >kept
        cat kept >first
        cat kept >log
        got=0
        { (
            ulimit -f 1
            [ $ignored = no ] || trap '' XFSZ
            exec "$accel" export teapots:quads=1 -o $name >>log 2>err
        ) || got=$?; } 2>/dev/null # the shell's own words about the signal
        [ $ignored = no ] && wanted=$((128 + $(kill -l XFSZ))) || wanted=2
        [ "$got" = $wanted ] || fail "-o $name beyond the limit: $got instead of $wanted"
        [ $ignored = no ] || grep -q "File too large; nothing was written" err || fail "-o $name: $(cat err)"
        for each in kept first second log; do
            head -c 1000 /dev/zero | tr '\0' o | cmp -s - $each || fail "-o $name: $each has changed"
        done
        no_temporary
    done
done

# full COMMAND...: with the output on a full disk.
full() {
    local file="${!#}"
    for state in new old linked; do
        rm -f full/*
        [ $state = new ] || echo old >"$file"
        [ $state != linked ] || ln "$file" full/second
        cat /dev/zero >full/fill 2>/dev/null || true
        expect 2 "$@"
        [ "$(wc -l <err)" = 1 ] && grep -q "No space left on device; nothing was written" err ||
            fail "a full disk, $*: $(cat err)"
        [ $state = new ] || [ "$(cat "$file")" = old ] || fail "a full disk, $*: the old content is lost"
        [ $state != linked ] || [ "$file" -ef full/second ] || fail "a full disk, $*: links are split"
        no_temporary full
    done
}
# small_disk FOLDER SIZE: where this may mount one.
disks=()
small_disk() {
    mount -t tmpfs -o "size=$2,mode=777" none "$1" 2>/dev/null || return
    disks+=("$work/$1")
}
trap '[ ${#disks[@]} = 0 ] || umount "${disks[@]}"; rm -rf "$work"' EXIT
mkdir full
if small_disk full 64k; then
    full export teapots:quads=3 -o full/x.inc
    full trace teapots --size 200x200 -o full/x.exr
    full trace teapots --size 400x400 -o full/x.png
    yes "$(cat rays.txt)" | head -n 20000 >many.txt || true
    full trace one --rays many.txt -o full/hits.txt
    full bench one -a linear -n 10 --repeats 1 --csv full/x.csv
    expect 0 trace teapots -o a.exr --size 400x400
    full diff a.exr a.exr -o full/x.png
    got=0
    if [ "$kind" != linear ] && command -v gnuplot >/dev/null; then
        rm full/*
        head -c 20000 /dev/zero >full/fill
        "$accel" report -o full/page --minutes 0 --only exact -q >out 2>err || got=$?
        [ $got = 2 ] && grep -q "No space left on device; nothing was written" err ||
            fail "a report on a full disk: $got, $(cat err)"
        [ "$(ls full)" = fill ] || fail "a report on a full disk leaves $(ls full)"
    fi
fi
complains "No space left on device" export one.obj -o /dev/full
ln -s /dev/full full.png && complains "No space left on device" trace one -o full.png
for arguments in "kinds" "info one" "check one -n 100" "bench one -n 10 --repeats 1 -a linear" \
    "bench one -n 10 --repeats 1 -a linear --csv" "bench one -n 10 --repeats 1 -a linear --csv -" \
    "photons one -n 10 --size 4x4" "diff file.exr file.exr" "export one.obj -o -" "--help" "--version" \
    "trace --help"; do
    for output in /dev/full closed; do
        got=0
        # shellcheck disable=SC2086
        case $output in
        closed) "$accel" $arguments >&- 2>err || got=$? ;;
        *) "$accel" $arguments >$output 2>err || got=$? ;;
        esac
        [ $got = 2 ] && [ "$(wc -l <err)" = 1 ] || fail "accel $arguments to $output: $got, $(cat err)"
        grep -qE "No space left on device|it is closed" err || fail "accel $arguments to $output: $(cat err)"
    done
done

# ---------------------------------------------------------------- as an ordinary user ----

umask 022
mkdir theirs && chmod 755 "$work" theirs
cp "$accel" theirs/accel
user=()
if [ "$(id -u)" = 0 ]; then
    user=(setpriv --reuid=65534 --regid=65534 --clear-groups)
    # The owner is kept, and the group.
    echo old >owned && chmod 640 owned && chown 65534:12 owned
    expect 0 export one.obj -o owned
    holds owned
    [ "$(stat -c %u:%g:%a owned)" = 65534:12:640 ] || fail "the owner is now $(stat -c %u:%g:%a owned)"
    if mknod block b 4000 77 2>/dev/null; then # of a driver that is not there
        complains "it is a block device" export one.obj -o block
    fi
fi
# mine WORDS ARGUMENT...: runs accel as the user: fine, or it complains with WORDS.
mine() {
    local words=$1 got=0
    shift
    "${user[@]}" env TMPDIR="$work/scratch" timeout 120 theirs/accel "$@" >out 2>err </dev/null || got=$?
    if [ -n "$words" ]; then
        [ $got = 2 ] && [ "$(wc -l <err)" = 1 ] && grep -qF "$words" err ||
            fail "accel $* as a user: $got, $(cat err)"
    else
        [ $got = 0 ] || fail "accel $* as a user: $got, $(cat err)"
    fi
}
mkdir locked scratch open
for state in writable readonly linked; do
    echo old >locked/$state
done
ln locked/linked locked/twin
chmod 444 locked/readonly
[ ${#user[@]} = 0 ] || chown 65534 locked/* scratch open
chmod 555 locked
chmod 1777 scratch
mine "" export one.obj -o locked/writable
holds locked/writable
mine "" export one.obj -o locked/linked
holds locked/twin
mine "Permission denied" export one.obj -o locked/readonly
mine "Permission denied" export one.obj -o locked/new
mine "Permission denied" export one.obj -o locked/new.inc
[ "$(cat locked/readonly)" = old ] || fail "a file that may not be written was"
[ -z "$(ls scratch)" ] || fail "$(ls scratch) is left in TMPDIR"
chmod 555 scratch
mine "Permission denied" export one.obj -o locked/writable
(
    ulimit -f 1
    trap '' XFSZ
    chmod 1777 scratch
    echo old >locked/writable
    mine "File too large; nothing was written" export teapots:quads=1 -o locked/writable
    [ "$(cat locked/writable)" = old ] && [ -z "$(ls scratch)" ] || fail "old content is lost"
    exit "$failures"
) || fail "a limit and a locked folder"
chmod 755 locked
if [ ${#user[@]} != 0 ]; then
    # A file of somebody else that all may write stays theirs, in a folder of ours and in a sticky one.
    for place in open scratch; do
        echo old >$place/shared && chown 0:0 $place/shared && chmod 666 $place/shared
        mine "" export one.obj -o $place/shared
        holds $place/shared
        [ "$(stat -c %u:%g:%a $place/shared)" = 0:0:666 ] || fail "$place/shared is now $(stat -c %u:%g:%a $place/shared)"
        no_temporary $place
    done
    # The kernel forbids to follow links of others in sticky folders.
    if [ "$(cat /proc/sys/fs/protected_symlinks)" = 1 ]; then
        chown 0:0 scratch
        setpriv --reuid=1 --regid=1 --clear-groups ln -s "$work/open/trap" scratch/bait
        mine "Permission denied" export one.obj -o scratch/bait
        [ ! -e open/trap ] || fail "a forbidden link is followed"
    fi
fi
# A report fills a folder that may be written in one that may not.
if [ "$kind" != linear ] && command -v gnuplot >/dev/null; then
    mkdir -m 700 locked/page
    [ ${#user[@]} = 0 ] || chown 65534:65534 locked/page
    chmod 555 locked
    mine "" report -o locked/page --minutes 0 --only exact -q
    [ -s locked/page/exact.csv ] && [ "$(stat -c %a locked/page)" = 700 ] || fail "no report in a locked folder"
    mine "Permission denied" report -o locked/more --minutes 0 -q
    chmod 755 locked
fi

# ---------------------------------------------------------------------------- scripts ----

# The scripts in a tree of which build/ may not be written, or is on a full disk: one clear line.
cp -r "$root/scenes" "$root/povray-adapter" theirs
mkdir -p theirs/tests theirs/build
cp "$root/tests/run.sh" theirs/tests
: >theirs/build/libaccel.a
for each in accel povray-accel; do
    printf '#!/bin/sh\n' >theirs/build/$each && chmod 755 theirs/build/$each
done
# refused WORDS SCRIPT ARGUMENT...
refused() {
    local words=$1 got=0
    shift
    "${user[@]}" timeout 60 "$@" >out 2>err </dev/null || got=$?
    [ $got = 1 ] && [ "$(wc -l <err)" = 1 ] && grep -qE "^(accel|povray-adapter): .*($words)" err ||
        fail "$*: $got, $(cat err)"
}
chmod 555 theirs/build
for script in "scenes/fetch.sh teapots" "scenes/demo.sh cubes" "scenes/times.sh 1" "tests/run.sh" \
    "povray-adapter/build.sh"; do
    # shellcheck disable=SC2086
    refused "Permission denied|cannot make the folder" theirs/$script
done
chmod 755 theirs/build
rm theirs/build/*
if small_disk theirs/build 16k; then
    printf '#!/bin/sh\n' >theirs/build/accel && chmod 755 theirs/build/accel
    cat /dev/zero >theirs/build/fill 2>/dev/null || true
    refused "No space left on device" theirs/scenes/fetch.sh teapots
    refused "No space left on device" theirs/scenes/demo.sh cubes
fi
finish
