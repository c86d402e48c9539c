#!/usr/bin/env bash
# Echoes whose strength varies and nothing else that is random: in the viewer the amplitude of the car
# ahead jumps by some decibels from scan to scan, and beyond 130 m it drops out now and then. With
# fluctuation taken from the list it fades evenly.
set -o pipefail
glint-traffic wet-road \
  | glint-extract \
  | glint-ideal --sensors lrr77-full --sections account \
      --effects=visibility,plane_reflection,rows,occlusion,merging,superposition,threshold,rain,fog,fluctuation \
  | glint-sensor \
  | glint-noise
