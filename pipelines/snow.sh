#!/usr/bin/env bash
# The heaviest snow on a highway: the farthest car on the left lane, left_5, is listed in half of the
# scans, and in 70 % of them with --effects=-snow: snow takes 2 dB over 170 m, there and back.
set -o pipefail
glint-traffic highway-straight --conditions '{"snow_mmph": 10}' \
  | glint-extract \
  | glint-ideal --sensors lrr77-full --sections account \
  | glint-sensor \
  | glint-noise
