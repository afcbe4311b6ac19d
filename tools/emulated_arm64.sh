#!/usr/bin/env bash
# Installs this tree in an arm64 Debian under emulation (qemu-user), and runs tests, a stepped run and a console there:
#
#     tools/emulated_arm64.sh FOLDER [PYTEST ARGUMENT ...]
#
# Needs root and, from the package manager: mmdebstrap arch-test qemu-user-static binfmt-support. FOLDER keeps the system
# (1 GB) for the next call. Without arguments pytest's default run takes place, which lasts hours there: name the folders
# of tests that matter. At the end it prints the digests of a stepped run here and there, which are to be equal, and what
# the stepped run and an attached console need there.
set -euo pipefail
tree=$(cd "$(dirname "$0")/.." && pwd)
root=$(mkdir -p "$1" && cd "$1" && pwd)
shift
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
inside() {
    chroot "$root" /usr/bin/env HOME=/root LANG=C.UTF-8 PATH=/srv/venv/bin:/usr/bin:/bin TERM=xterm-256color \
        sh -c "cd /srv/tree && $1"
}

rm -rf "$root/srv/tree" "$root/srv/wheels" && mkdir -p "$root/srv/tree"
git -C "$tree" archive HEAD | tar -x -C "$root/srv/tree"
python3 -m pip wheel -q --no-deps -w "$root/srv/wheels" "$root/srv/tree"
[ -e "$root/srv/venv" ] || inside 'python3 -m venv --without-pip /srv/venv'
# This machine's pip fetches the wheels for the other: an emulated one takes half an hour for it.
python3 -m pip install -q --upgrade --target "$root$site" --python-version 3.11 --only-binary :all: \
    --platform manylinux_2_34_aarch64 --platform manylinux_2_28_aarch64 --platform manylinux2014_aarch64 \
    "$(ls "$root"/srv/wheels/bot_console-*.whl)[dev]"
printf '#!/srv/venv/bin/python\nfrom bot_console.tui.cli.main import program\nprogram()\n' > "$root/srv/venv/bin/bot-console"
chmod +x "$root/srv/venv/bin/bot-console"

inside 'uname -m; bot-console --version'
inside "python -m pytest -q -o timeout=3000 $*" || echo "pytest ended with $?"
echo "there: $(inside "/usr/bin/time -v -o /tmp/run bot-console ${run[*]} 2>/dev/null" | python3 -c "$digest")"
echo "here:  $(bot-console "${run[@]}" 2>/dev/null | python3 -c "$digest")"
inside 'bot-console --headless --duration 1e9 >/dev/null 2>&1 & robot=$!
    script -qec "/usr/bin/time -v -o /tmp/attach timeout --foreground -k 60 120 python -m bot_console.tui attach" \
        /dev/null >/dev/null </dev/null
    kill -INT $robot' || true # timeout ends with 124
for what in run attach; do
    echo "$what there:"
    grep -E 'Maximum resident|User time|System time|Elapsed' "$root/tmp/$what"
done
