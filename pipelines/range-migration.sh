#!/usr/bin/env bash
# A highway by a corner radar that looks for 70 ms. What the ego passes at 30 m/s walks 14 range cells
# meanwhile, so that posts and rails fade; cars of the ego's speed stay as they are. With
# --effects=-range_migration the lists have a third more targets.
set -o pipefail
glint-traffic highway-straight \
  | glint-extract \
  | glint-ideal --sensors corner77-uncompensated --sections account \
  | glint-sensor \
  | glint-noise
