#!/usr/bin/env bash
# A highway from a trajectory table, seen by a 77 GHz long-range radar. The table has 10 steps a
# second, fewer than the radar has scans, so the suite without a cycle is used: a scan every frame.
set -o pipefail
glint-traffic highway --ego 1 --radius-m 250 \
  | glint-extract \
  | glint-ideal --sensors lrr77-every-frame --sections account \
  | glint-sensor \
  | glint-noise
