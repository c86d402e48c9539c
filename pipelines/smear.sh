#!/usr/bin/env bash
# The cut-in as a range-Doppler transform would show it: every echo is spread over the bins around
# it, so that reflection centres less than two cells apart merge by degrees instead of at a cell's
# edge, and pull at each other's range and rate before. Swap glint-sensor for it and the list is
# longer: its cells are half as wide as what a transform can tell apart.
set -o pipefail
glint-traffic cut-in \
  | glint-extract \
  | glint-ideal --sensors corner77 --sections account \
  | glint-sensor-smear \
  | glint-noise
