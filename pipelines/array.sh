#!/usr/bin/env bash
# The two cars of two-vehicles.sh before a radar with 16 elements: each has a target of its own, where
# it is. Their echoes share a cell of range and range rate, and the beams of the array part them.
set -o pipefail
glint-traffic two-vehicles \
  | glint-extract \
  | glint-ideal --sensors array77 --sections account \
  | glint-sensor \
  | glint-noise
