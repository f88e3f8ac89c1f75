#!/bin/sh
# Installs the Debian packages of sets that are not there yet. A set is the "# apt SET:" lines of cmake/dependencies.cmake
# and its "# apt-command SET: COMMAND PACKAGE" lines, whose package is installed only if the command is missing.
#
#    tools/install_packages.sh SET...         says how much is downloaded, then installs
#    tools/install_packages.sh --say SET...   says alone what the sets would add; says nothing if nothing is missing
#    tools/install_packages.sh --list         names all sets
#
# A line "# apt-sets NAME: SET..." gives several sets one name.
set -eu
cd "$(dirname "$0")/.."
list=cmake/dependencies.cmake
sets=$(sed -n 's/^# apt\(-command\)\{0,1\} \([a-z-]*\):.*/\2/p' $list | awk '!seen[$0]++')

case ${1:-} in
  --list)
    echo "$sets"
    exit
    ;;
  --say)
    only_say=yes
    shift
    ;;
  -h | --help | "")
    sed -n '2,/^set/s/^# \{0,1\}//p' tools/install_packages.sh
    exit
    ;;
esac

wanted=""
for name in "$@"; do
  several=$(sed -n "s/^# apt-sets $name: //p" $list)
  wanted="$wanted ${several:-$name}"
done
missing=""
for set in $wanted; do
  if ! echo "$sets" | grep -qx -- "$set"; then
    echo "install_packages.sh: there is no set $set; the sets are:" $sets >&2
    exit 1
  fi
  for package in $(sed -n "s/^# apt $set: //p" $list); do
    status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
    [ "$status" = installed ] || missing="$missing $package"
  done
  missing="$missing$(sed -n "s/^# apt-command $set: //p" $list | while read -r command package; do
    command -v "$command" >/dev/null || printf ' %s' "$package"
  done)"
done
[ -n "$missing" ] || exit 0

if [ "$(id -u)" -eq 0 ]; then
  as_root=""
elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
  as_root="sudo"
elif [ -n "${only_say:-}" ]; then
  as_root=""
else
  echo "install_packages.sh: these packages are missing and neither root nor sudo is available:" >&2
  echo "  apt-get install$missing" >&2
  exit 1
fi

# apt-get's own account of an installation, such as "121 newly installed", "Need to get 131 MB", "678 MB of additional".
account() {
  # shellcheck disable=SC2086  # one word a package
  LC_ALL=C $as_root apt-get install --assume-no --no-install-recommends $missing 2>/dev/null | awk '
    / newly installed/ { packages = $3 }
    /^Need to get/ { download = $0; sub(/^Need to get /, "", download); sub(/ of archives\..*/, "", download); sub(/\/.*/, "", download) }
    / disk space will be used/ { disk = $0; sub(/^After this operation, /, "", disk); sub(/ of additional.*/, "", disk) }
    END { if (packages > 0) printf "%s packages, %s to download, %s on the disk", packages, download, disk }'
}
[ -n "${only_say:-}" ] || $as_root apt-get update -qq
said=$(account)
if [ -n "${only_say:-}" ]; then
  echo "${said:-unknown packages}"
  exit
fi
echo "installing ($*):${said:+ $said:}$missing"
# shellcheck disable=SC2086  # one word a package
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing
