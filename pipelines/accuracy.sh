#!/usr/bin/env bash
# Accuracy by signal-to-noise ratio: in glint-view, the posts of the guardrail are read to 5 cm in range
# at 30 m and to 15 cm at 100 m; the car ahead, much stronger, stays at 5 cm until it is far away.
set -o pipefail
glint-traffic open-road \
  | glint-extract \
  | glint-ideal --sensors lrr77-full --sections account \
      --effects visibility,plane_reflection,rows,occlusion,merging,superposition,threshold,angle_noise,range_noise,accuracy \
  | glint-sensor \
  | glint-noise
