#!/usr/bin/env bash
# A highway from a trajectory table, seen by a 77 GHz long-range radar. The table has 10 steps a
# second, fewer than the radar has scans, so the radar scans once in every step.
set -o pipefail
glint-traffic highway --ego 1 --radius-m 250 \
  | glint-extract \
  | glint-ideal --sensors lrr77 --sections account \
  | glint-sensor \
  | glint-noise
