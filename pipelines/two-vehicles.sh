#!/usr/bin/env bash
# Figure 10: two cars side by side share one resolution cell, and the radar reports one target in
# the middle, where nobody is.
set -o pipefail
glint-traffic two-vehicles \
  | glint-extract \
  | glint-ideal --sensors srr24-pair --sections account \
  | glint-sensor \
  | glint-noise
