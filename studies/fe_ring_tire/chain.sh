#!/bin/sh
# The whole chain, from the finite-element tire to the verdict on the ring: what tire.toml shows (measure.py), the ring from
# its loads and modes, the ring from these and two cleats, and both beside it over the held-out cleats.
#
#   studies/fe_ring_tire/chain.sh build/release/bin/latsch
#
# It takes some half an hour of processor time and replaces the files of measured/, standing_ring.toml and fitted.toml. For a tire
# of your own put its description in place of tire.toml, and its radius, pressure and tread into ring.toml.
set -e
latsch=$(realpath "${1:?the program, such as build/release/bin/latsch}")
cd "$(dirname "$0")"
python3 measure.py "$latsch" measured
"$latsch" run standing.toml
"$latsch" export standing.toml --model standing_ring.toml
"$latsch" run study.toml
"$latsch" export study.toml --model fitted.toml
"$latsch" compare comparison.toml
