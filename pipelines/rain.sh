#!/usr/bin/env bash
# Heavy rain and some fog, without what other radars add: the car that pulls away ahead is in 179 of 241
# scans, at most 146 m away; with --effects=-interference,-rain in 219, up to 152 m. The van 170 m ahead is
# lost in both.
set -o pipefail
glint-traffic wet-road \
  | glint-extract \
  | glint-ideal --sensors lrr77-full --sections account \
      --effects=-interference \
  | glint-sensor \
  | glint-noise
