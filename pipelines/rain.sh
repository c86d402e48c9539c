#!/usr/bin/env bash
# Heavy rain and some fog, without what other radars add: in the viewer the van 170 m ahead is a target now
# and then, and lost below the threshold else; with --effects=-interference,-rain it is there most of the
# time. How strong an echo is also varies from scan to scan (level).
set -o pipefail
glint-traffic wet-road \
  | glint-extract \
  | glint-ideal --sensors lrr77-full --sections account \
      --effects=-interference \
  | glint-sensor \
  | glint-noise
