#!/usr/bin/env bash
# The two cars of two-vehicles.sh before a radar with 16 elements: each has a target of its own. Their
# echoes share a cell of range and range rate, and the beams of the array part them by azimuth. Corners
# of one car are too near to each other for the beams; where their waves cancel, they pull its target aside.
set -o pipefail
glint-traffic two-vehicles \
  | glint-extract \
  | glint-ideal --sensors array77 --sections account \
  | glint-sensor \
  | glint-noise
