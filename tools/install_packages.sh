#!/bin/sh
# Installs the Debian packages named by the "# apt:" lines of cmake/dependencies.cmake that are not there yet, and those of
# the "# apt-command: COMMAND PACKAGE" lines whose command is not there. With the name of a purpose, such as api-pages,
# it installs the packages of the "# apt-for-PURPOSE:" lines instead.
set -eu
cd "$(dirname "$0")/.."

missing=""
for package in $(sed -n "s/^# apt${1:+-for-$1}: //p" cmake/dependencies.cmake); do
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing="$missing $package"
done
commands=$([ -n "${1:-}" ] || sed -n 's/^# apt-command: //p' cmake/dependencies.cmake | while read -r name package; do
  command -v "$name" >/dev/null || printf ' %s' "$package"
done)
missing="$missing$commands"
[ -n "$missing" ] || exit 0

echo "installing:$missing"
if [ "$(id -u)" -eq 0 ]; then
  as_root=""
elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
  as_root="sudo"
else
  echo "install_packages.sh: these packages are missing and neither root nor sudo is available:" >&2
  echo "  apt-get install$missing" >&2
  exit 1
fi
$as_root apt-get update -qq
# shellcheck disable=SC2086  # one word a package
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing
