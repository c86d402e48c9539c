#!/usr/bin/env bash
# False alarms: in every second scan noise passes the threshold somewhere. In glint-view, coloured by
# path, they stand out for a single frame, anywhere in the beam and at any speed.
set -o pipefail
glint-traffic open-road \
  | glint-extract \
  | glint-ideal --sensors lrr77-full --sections account \
      --effects visibility,plane_reflection,rows,occlusion,merging,superposition,threshold,angle_noise,range_noise,false_alarms \
  | glint-sensor \
  | glint-noise
