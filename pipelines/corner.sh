#!/usr/bin/env bash
# Figures 1 and 2 of the paper: a car approaches with a corner ahead. The corner is always in the
# list; the wheel houses join it only at small distances.
set -o pipefail
glint-traffic corner-approach \
  | glint-extract \
  | glint-ideal --sensors srr24-pair --sections account \
  | glint-sensor \
  | glint-noise
