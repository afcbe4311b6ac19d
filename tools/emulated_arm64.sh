#!/usr/bin/env bash
# Installs this tree in an arm64 Debian under emulation (qemu-user), and tries it there, part by part:
#
#     tools/emulated_arm64.sh FOLDER [PART ...]
#
# A PART is a folder or file of tests, named from `tests` on (`unit/rmw`, `pilot`); `runtime`, the unit tests of all but
# the console; `digest`, which prints the digests of a stepped run here and there, which are to be equal; or `attach`,
# which prints what a console needs there beside a robot. Without one, all of pytest's default run and the last two take
# place, in the order of `parts` below: that lasts hours. FOLDER keeps the system (1 GB) and what each part printed
# (`reports/`) for the next call.
#
# Needs root and, from the package manager: mmdebstrap arch-test qemu-user-static binfmt-support.
set -euo pipefail
tree=$(cd "$(dirname "$0")/.." && pwd)
folder=$(mkdir -p "$1/system" "$1/reports" && cd "$1" && pwd)
shift
root=$folder/system
parts=(digest attach runtime property contract course project unit/tui snapshot pilot acceptance soak)
if [ $# -gt 0 ]; then parts=("$@"); fi
site=/srv/venv/lib/python3.11/site-packages
run=(--headless --fast --duration 5 seed:=3)
digest='import json, sys; run = json.load(sys.stdin); print(run["digest_version"], run["digest"])'

mountpoint -q /proc/sys/fs/binfmt_misc || mount -t binfmt_misc binfmt_misc /proc/sys/fs/binfmt_misc
update-binfmts --enable qemu-aarch64
if [ ! -x "$root/usr/bin/python3" ]; then
    mmdebstrap --architectures=arm64 --variant=apt --include=python3,python3-venv,git,time,procps bookworm "$root"
fi
for each in proc dev; do
    # A slave: what is unmounted at the end stays mounted outside.
    mountpoint -q "$root/$each" || { mount --rbind "/$each" "$root/$each" && mount --make-rslave "$root/$each"; }
done
trap 'umount -R -l "$root/proc" "$root/dev"' EXIT
[ -e "$root/etc/hosts" ] || echo 127.0.0.1 localhost > "$root/etc/hosts" # else it is looked up in the network

settings=(HOME=/root LANG=C.UTF-8 PATH=/srv/venv/bin:/usr/bin:/bin TERM=xterm-256color)
for each in BOT_CONSOLE_COURSE BOT_CONSOLE_ORACLE; do
    if [ -n "${!each:-}" ]; then
        rm -rf "$root/srv/$each" && cp -r "${!each}" "$root/srv/$each"
        settings+=("$each=/srv/$each")
    fi
done
inside() { chroot "$root" /usr/bin/env "${settings[@]}" sh -c "cd /srv/tree && $1"; }

install_tree() {
    rm -rf "$root/srv/tree" "$root/srv/wheels" && mkdir -p "$root/srv/tree"
    git -C "$tree" archive HEAD | tar -x -C "$root/srv/tree"
    python3 -m pip wheel -q --no-deps -w "$root/srv/wheels" "$root/srv/tree"
    [ -e "$root/srv/venv" ] || inside 'python3 -m venv --without-pip /srv/venv'
    # This machine's pip fetches the wheels for the other: an emulated one takes half an hour for it.
    python3 -m pip install -q --upgrade --target "$root$site" --python-version 3.11 --only-binary :all: \
        --platform manylinux_2_34_aarch64 --platform manylinux_2_28_aarch64 --platform manylinux2014_aarch64 \
        "$(ls "$root"/srv/wheels/bot_console-*.whl)[dev]"
    printf '#!/srv/venv/bin/python\nfrom bot_console.tui.cli.entry import program\nprogram()\n' > "$root/srv/venv/bin/bot-console"
    chmod +x "$root/srv/venv/bin/bot-console"
    inside 'uname -m; bot-console --version'
}

same_digest() {
    echo "there: $(inside "/usr/bin/time -v -o /tmp/run bot-console ${run[*]} 2>/dev/null" | python3 -c "$digest")"
    echo "here:  $(bot-console "${run[@]}" 2>/dev/null | python3 -c "$digest")"
    needed run
}

attached_console() {
    inside 'bot-console --headless --duration 1e9 >/dev/null 2>&1 & robot=$!
        script -qec "/usr/bin/time -v -o /tmp/attach timeout --foreground -k 60 120 python -m bot_console.tui attach" \
            /dev/null >/dev/null </dev/null
        kill -INT $robot' || true # timeout ends with 124
    needed attach
}

needed() { grep -E 'Maximum resident|User time|System time|Elapsed' "$root/tmp/$1"; }

tests_of() { inside "python -m pytest -q -n 2 -o timeout=3000 $*" || echo "pytest ended with $?"; }

install_tree
for part in "${parts[@]}"; do
    echo "== $part"
    case $part in
        digest) same_digest ;;
        attach) attached_console ;;
        runtime) tests_of tests/unit --ignore=tests/unit/tui ;;
        *) tests_of "tests/$part" ;;
    esac 2>&1 | tee "$folder/reports/${part//\//-}.txt"
done
