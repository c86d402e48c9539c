#!/usr/bin/env bash
# Levels of bodies and nothing else that is random: in the viewer the amplitude of the car ahead glides
# by some decibels as it pulls away, and a car that comes towards it is weak or strong for many scans. Without
# level in the list amplitudes change smoothly, with range and direction.
set -o pipefail
glint-traffic wet-road \
  | glint-extract \
  | glint-ideal --sensors lrr77-full --sections account \
      --effects=visibility,plane_reflection,rows,occlusion,merging,superposition,threshold,rain,fog,level \
  | glint-sensor \
  | glint-noise
