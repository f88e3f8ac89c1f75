#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# tools/container.sh [ROOT FOLDER]   carries out the lines of Containerfile without an engine for containers: FROM is a bare Debian
#                                    (mmdebstrap, root), RUN a shell in it (unshare); then runs latsch there as the lines say, by
#                                    its user, and asks the page for its studies. The packages have to be there: tools/package.sh
set -eu
cd "$(dirname "$0")/.."
ls build/packages/latsch_*.deb >/dev/null 2>&1 || { echo "container.sh: there is no build/packages/latsch_*.deb; tools/package.sh makes it" >&2; exit 1; }
tools/install_packages.sh bare
root=${1:-build/container}
keep=${1:+yes}
trap '[ -n "$keep" ] || rm -rf "$root"' EXIT
rm -rf "$root"
mkdir -p "$(dirname "$root")"
user=root directory=/ entry="" port=""

# Runs a line of shell in the root; /proc is mounted for its processes alone.
in_root() {
  unshare --mount --pid --fork --kill-child --mount-proc="$root/proc" chroot "$root" sh -c "$1"
}

while read -r word rest; do
  case $word in
    '' | '#'*) continue ;;
  esac
  echo "$word $rest"
  case $word in
    FROM)
      suite=${rest#debian:}
      mmdebstrap --quiet --variant=minbase "${suite%-slim}" "$root" http://deb.debian.org/debian
      cp /etc/resolv.conf "$root/etc/resolv.conf"
      cp -r /etc/apt/apt.conf.d/. "$root/etc/apt/apt.conf.d/"  # such as the address of a mirror
      bare=$(du -sm --exclude=proc "$root" | cut -f1)
      ;;
    COPY)
      mkdir -p "$root${rest##* }"
      # shellcheck disable=SC2086  # the pattern stands for files
      cp ${rest% *} "$root${rest##* }"
      ;;
    RUN) in_root "$rest" >"$root/said" 2>&1 || { cat "$root/said" >&2; exit 1; } ;;
    USER) user=$rest ;;
    WORKDIR) directory=$rest ;;
    EXPOSE) port=$rest ;;
    ENTRYPOINT) entry=$(echo "$rest" | tr -d '[]",') ;;
    CMD) ;;
    *) echo "container.sh: Containerfile has the line $word, which this script does not know" >&2; exit 1 ;;
  esac
done <Containerfile
echo "the container has $(du -sm --exclude=proc --exclude=var/cache "$root" | cut -f1) MB, $bare of them Debian"

run() {
  echo "== $entry $*"
  in_root "cd $directory && HOME=/home/$user exec setpriv --reuid=$user --regid=$user --clear-groups $entry $*"
}
run --version
run new tire --coarse >/dev/null
run run tire/study.toml --workers 2 >/dev/null
test -s "$root$directory/tire/study.html"
test "$(stat -c %u "$root$directory/tire/study.html")" = 1000
# The page is served in the root, and read from outside of it.
echo "== $entry serve"
: >"$root/served"
unshare --mount --pid --fork --kill-child --mount-proc="$root/proc" chroot "$root" sh -c \
  "cd $directory && HOME=/home/$user exec setpriv --reuid=$user --regid=$user --clear-groups $entry serve . --listen 0.0.0.0 --port $port --no-browser" \
  >"$root/served" 2>&1 &
server=$!
for _ in 1 2 3 4 5 6 7 8 9 10; do
  grep -q 'http://' "$root/served" && break
  sleep 1
done
token=$(sed -n 's/.*token=\([^& ]*\).*/\1/p' "$root/served" | head -n 1)
python3 - "http://127.0.0.1:$port" "$token" <<'P'
import json, sys, urllib.request
base, token = sys.argv[1:]
request = urllib.request.Request(base + "/api/home", headers={"Authorization": "Bearer " + token})
studies = [one["study"] for one in json.load(urllib.request.urlopen(request))["studies"]]
assert studies == ["tire/study.toml"], studies
P
kill "$(ps -o pid= --ppid $server)"  # unshare itself waits for it
wait $server || true
echo "== all of it works"
