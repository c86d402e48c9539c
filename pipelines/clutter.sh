#!/usr/bin/env bash
# Clutter. In the viewer, coloured by path, the gravel before the ego is full of targets that flicker
# from scan to scan and all move as the ground does: their range rates follow the ego as it brakes and
# turns. With --effects=-clutter for glint-ideal only the car ahead is left, and false alarms.
set -o pipefail
glint-traffic gravel \
  | glint-extract \
  | glint-ideal --sensors lrr77-full --sections account \
  | glint-sensor \
  | glint-noise
