#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Run by package.sh in a bare Debian 12 that has the packages in /packages: installs the program, measures how long a new
# user waits for the first report, then installs the other packages and uses what they bring.
set -eu
export DEBIAN_FRONTEND=noninteractive HOME=/root
apt-get update -qq
install() {
  LC_ALL=C apt-get install --assume-no --no-install-recommends "$@" 2>/dev/null | grep -e 'newly installed' -e '^Need to get' -e '^After this' || true
  apt-get install -y -qq --no-install-recommends "$@" >/packages/install.log 2>&1 || { cat /packages/install.log; exit 1; }
}
cd "$(mktemp -d)"
try() {
  echo "== $*"
  "$@" >/tmp/said 2>&1 || { cat /tmp/said; exit 1; }
}
echo "bytes to download, package by package:"
{ stat -c '%s %n' /packages/latsch_*.deb
  apt-get install --print-uris -y --no-install-recommends /packages/latsch_*.deb | awk "/^'http/ { print \$3, \$2 }"
} | sort -rn | awk '{ print; sum += $1 } END { printf "%d in %d packages\n", sum, NR }'
began=$(date +%s)
install /packages/latsch_*.deb
installed=$(date +%s)
try latsch new first_tire
try latsch run first_tire/study.toml --workers 2
test -s first_tire/study.html
ended=$(date +%s)
echo "from the package to a program: $((installed - began)) s; from there to the first report: $((ended - installed)) s"
latsch --version | grep 'MPI  *no'
install /packages/*.deb
latsch --version
if latsch export /packages/tire.toml --fmu 3.0 --platforms linux -o linux.fmu >/dev/null && [ -e /usr/lib/latsch/latsch_sti.dll ]; then
  try latsch export /packages/tire.toml --fmu 3.0 --platforms linux,windows -o both.fmu
fi
ldd /usr/bin/latsch | grep openblas-serial
try latsch new my_tire --coarse
try latsch check my_tire/study.toml
head -n 1 my_tire/study.toml | grep -x '#:schema file:///usr/share/latsch/schemas/latsch-study.json'
try latsch help --schema study
try latsch run /packages/compliance/study.toml --workers 2
tail -n 3 /tmp/said
try latsch new my_car --car
try latsch export /packages/tire.toml --fmu 3.0 -o tire.fmu
try man -w latsch
latsch serve /packages --no-browser >/tmp/serve.log 2>&1 &
server=$!
for _ in 1 2 3 4 5; do
  grep -q http: /tmp/serve.log && break
  sleep 1
done
address=$(grep -o 'http://[^ ]*' /tmp/serve.log | head -n 1)
echo "== latsch serve: $(echo "$address" | sed 's/[?#].*//')"
try python3 - "$address" <<'P'
import json, re, sys, urllib.request
base, token = re.match(r"(http://[^/]+)/.*?token=([^&]+)", sys.argv[1]).groups()
request = urllib.request.Request(base + "/api/home", headers={"Authorization": "Bearer " + token})
home = json.load(urllib.request.urlopen(request))
assert [one["study"] for one in home["studies"]], home
P
kill $server
try python3 - <<'P'
import latsch
study = latsch.read_study("/packages/compliance/study.toml")
assert study.run(progress=False)["target"] == study.best().target
assert latsch.test("/packages/compliance/corner.toml", {"kind": "kc", "Fy": "-4 kN"})["toe"].shape == (1,)
P
bash -ic 'source /usr/share/bash-completion/bash_completion; _completion_loader latsch
COMP_WORDS=(latsch ru); COMP_CWORD=1; _latsch; [ "${COMPREPLY[*]}" = run ] || exit 1
COMP_WORDS=(latsch run --wor); COMP_CWORD=2; _latsch; [ "${COMPREPLY[*]}" = --workers ]' 2>/dev/null
echo "== all of it works"
