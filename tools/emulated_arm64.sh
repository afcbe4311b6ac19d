#!/usr/bin/env bash
# Installs this tree in an arm64 Debian under emulation (qemu-user), and runs tests, a stepped run and a console there:
#
#     tools/emulated_arm64.sh FOLDER [PYTEST ARGUMENT ...]
#
# Needs root and, from the package manager: mmdebstrap arch-test qemu-user-static binfmt-support. FOLDER keeps the system
# (1 GB) for the next call. Without arguments for pytest its default run takes place, which takes hours there: name the
# folders of tests that matter. At the end it prints the digests of a stepped run here and there, which are to be equal,
# and the memory and CPU time that the stepped run and `attach` take there.
set -euo pipefail
tree=$(cd "$(dirname "$0")/.." && pwd)
root=$(mkdir -p "$1" && cd "$1" && pwd)
shift
run="--headless --fast --duration 5 seed:=3"
digest='import json, sys; run = json.load(sys.stdin); print(run["digest_version"], run["digest"])'

mountpoint -q /proc/sys/fs/binfmt_misc || mount -t binfmt_misc binfmt_misc /proc/sys/fs/binfmt_misc
update-binfmts --enable qemu-aarch64
if [ ! -x "$root/usr/bin/python3" ]; then
    mmdebstrap --architectures=arm64 --variant=apt \
        --include=python3,python3-venv,python3-dev,ca-certificates,git,time,procps,tmux,gcc,libc6-dev bookworm "$root"
fi
