# The virtual drum rig on every test of the study; latsch has to be on the PATH.
set -e
for test in slow fast cambered oblique; do
  latsch drum tire.toml $test.toml --output $test.csv
done
