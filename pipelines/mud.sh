#!/usr/bin/env bash
# A stage of your own, in any language: mud on the bumper blinds a sector of both sensors. Run it with
# bash, from the folder above; glint runs its own stages only.
set -o pipefail
glint-traffic intersection \
  | glint-extract \
  | glint-ideal --sensors srr24-pair --sections account \
  | python3 pipelines/mud.py -0.2 0.1 \
  | glint-sensor \
  | glint-noise
