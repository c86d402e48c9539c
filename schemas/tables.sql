-- The tables of glint-tables for DuckDB: FROM detections('FOLDER').
-- With reals := 'FLOAT', real numbers are in single precision, except times and origins.
-- The dialect is not detected: DuckDB would take the name ' for a quotation mark.

CREATE OR REPLACE MACRO detections(folder, reals := 'DOUBLE') AS TABLE
FROM read_csv(folder || '/detections.csv*', header = true, auto_detect = false, columns = {
    "detection_key": 'BIGINT', -- number of this row
    "scan_key": 'BIGINT', -- row of scans
    "frame_key": 'BIGINT', -- row of frames
    "detection": 'BIGINT', -- place in the sensor's list, from 0
    "scene": 'VARCHAR', -- unique in a set: source, ego, variant
    "frame": 'BIGINT', -- number in the scene, from 0
    "time_s": 'DOUBLE', -- s: end of the interval that the frame stands for
    "sensor": 'VARCHAR', -- name in the suite
    "range_m": reals, -- m: as reported
    "azimuth_rad": reals, -- rad: as reported
    "elevation_rad": reals, -- rad: as reported, positive upwards
    "range_rate_mps": reals, -- m/s: as reported
    "amplitude_db": reals, -- dB: as reported, 20 log10
    "sign_undecided": 'BOOLEAN', -- the phase between the channels does not tell left from right
    "cell_range_m": reals, -- m: of the cell, without noise
    "cell_azimuth_rad": reals, -- rad: of the cell, without noise
    "cell_elevation_rad": reals, -- rad: of the cell, without noise
    "cell_range_rate_mps": reals, -- m/s: of the cell, without noise
    "cell_amplitude": reals, -- sum of the contributors' amplitudes, linear
    "cell_sum": reals, -- of the cell's sum pointer, without noise, linear
    "effects": 'VARCHAR', -- effects that changed a value of the target or of a contributor
    "margins_sight_m": reals, -- m: of range, view, visibility and sight lines; angles times range
    "margins_threshold_db": reals, -- dB: between the amplitude and the threshold
    "margins_leader_db": reals, -- dB: between two echoes of which the stronger opened a cell
    "margins_cell_edge": reals, -- from the border of a cell, in half cells
    "margins_sign": reals, -- sine of the phase between sum and delta; 0 is undecided
    "margins_limit_db": reals, -- dB: from the list's limit, in a list by amplitude
    "margins_limit_m": reals, -- m: from the list's limit, in a list by range
    "quality_snr_db": reals, -- dB: power over that of the noise
    "quality_rcs_dbsm": reals, -- dBsm: cross section by amplitude, range and azimuth
    "quality_range_sd_m": reals, -- m: standard deviation
    "quality_range_rate_sd_mps": reals, -- m/s: standard deviation
    "quality_azimuth_sd_rad": reals, -- rad: standard deviation
    "quality_elevation_sd_rad": reals, -- rad: standard deviation
    "quality_existence": reals, -- probability of an echo, not noise alone
    "quality_range_rate_interval_mps": reals, -- m/s: range rates this far apart read alike
    "quality_ambiguity_number": 'BIGINT', -- true range rate less the reported one, in such intervals
    "quality_looks_merged": 'BOOLEAN', -- do the channels or elements show several echoes, beyond noise?
    "quality_merged_objects": 'BOOLEAN', -- are contributors of several objects?
    "quality_merged_reflectors": 'BOOLEAN', -- are contributors of several reflectors?
    "quality_range_rate_over_ground_mps": reals, -- m/s: 0 for what stands
    "quality_x_sensor_m": reals, -- m: from the sensor, along its boresight
    "quality_y_sensor_m": reals, -- m: from the sensor, to the left of its boresight
    "quality_x_centre_m": reals, -- m: from the centre of the ego's box, forward
    "quality_y_centre_m": reals, -- m: from the centre of the ego's box, to the left
    "quality_x_rear_axle_m": reals, -- m: from the middle of the rear axle, forward
    "quality_y_rear_axle_m": reals, -- m: from the middle of the rear axle, to the left
    "quality_x_world_m": reals, -- m: from the frame's origin, as objects
    "quality_y_world_m": reals, -- m: from the frame's origin, as objects
    "object_key": 'BIGINT', -- row of objects
    "class": 'VARCHAR', -- class of the object
    "contributors": 'BIGINT', -- echoes in the label
    "radar_ghost_label": 'BIGINT', -- as in the Radar Ghost data set
    "object": 'VARCHAR', -- id of the object
    "reflector": 'VARCHAR', -- name of the reflector in its set
    "path": 'VARCHAR', -- path of the echo's wave
    "mirror": 'VARCHAR', -- id of the object that mirrors, on paths by a wall
    "number": 'BIGINT', -- from 1, if there may be several that are else alike
    "weight": reals, -- share of the cell's amplitude
    "sensor_x_m": reals, -- m: place of the sensor at the measurement, from the frame's origin
    "sensor_y_m": reals, -- m: place of the sensor at the measurement, from the frame's origin
    "sensor_yaw_rad": reals, -- rad: direction of its boresight
    "sensor_vx_mps": reals, -- m/s: velocity of the sensor
    "sensor_vy_mps": reals, -- m/s: velocity of the sensor
});

CREATE OR REPLACE MACRO objects(folder, reals := 'DOUBLE') AS TABLE
FROM read_csv(folder || '/objects.csv*', header = true, auto_detect = false, columns = {
    "object_key": 'BIGINT', -- number of this row
    "frame_key": 'BIGINT', -- row of frames
    "scene": 'VARCHAR', -- unique in a set: source, ego, variant
    "frame": 'BIGINT', -- number in the scene, from 0
    "time_s": 'DOUBLE', -- s: end of the interval that the frame stands for
    "id": 'VARCHAR', -- unique in the frame
    "class": 'VARCHAR', -- name of the vehicle document
    "x_m": reals, -- m: centre of the box, from the frame's origin
    "y_m": reals, -- m: centre of the box, from the frame's origin
    "yaw_rad": reals, -- rad: heading of the box
    "vx_mps": reals, -- m/s: velocity of the centre
    "vy_mps": reals, -- m/s: velocity of the centre
    "yaw_rate_radps": reals, -- rad/s: turn rate
    "length_m": reals, -- m: 0: that of the class
    "width_m": reals, -- m: 0: that of the class
    "height_m": reals, -- m: 0: that of the class
    "travelled_m": reals, -- m: distance since the scene began
});

CREATE OR REPLACE MACRO scans(folder, reals := 'DOUBLE') AS TABLE
FROM read_csv(folder || '/scans.csv*', header = true, auto_detect = false, columns = {
    "scan_key": 'BIGINT', -- number of this row
    "frame_key": 'BIGINT', -- row of frames
    "scene": 'VARCHAR', -- unique in a set: source, ego, variant
    "frame": 'BIGINT', -- number in the scene, from 0
    "time_s": 'DOUBLE', -- s: end of the interval that the frame stands for
    "seed": 'UBIGINT', -- seed of all random numbers
    "interval_s": 'DOUBLE', -- s: length of that interval
    "last": 'BOOLEAN', -- is this the scene's last frame?
    "ego": 'VARCHAR', -- id of the object that carries the sensors
    "origin_x_m": 'DOUBLE', -- m: origin of the frame's coordinates in those of the source
    "origin_y_m": 'DOUBLE', -- m: origin of the frame's coordinates in those of the source
    "suite": 'VARCHAR', -- name of the suite document
    "sensor": 'VARCHAR', -- name in the suite
    "measured_s": 'DOUBLE', -- s: instant of the measurement
    "detections": 'BIGINT', -- targets of this scan
    "sensor_x_m": reals, -- m: place of the sensor at the measurement, from the frame's origin
    "sensor_y_m": reals, -- m: place of the sensor at the measurement, from the frame's origin
    "sensor_yaw_rad": reals, -- rad: direction of its boresight
    "sensor_vx_mps": reals, -- m/s: velocity of the sensor
    "sensor_vy_mps": reals, -- m/s: velocity of the sensor
    "mount_x_m": reals, -- m: from the centre of the ego's box
    "mount_y_m": reals, -- m: from the centre of the ego's box
    "mount_z_m": reals, -- m: height above the road; absent: not known
    "mount_yaw_rad": reals, -- rad: boresight, from the ego's heading
    "field_of_view_rad": reals, -- rad: full width
    "range_max_m": reals, -- m: greatest range
    "cell_range_m": reals, -- m: stated cell, full width: the unit of scores
    "cell_range_rate_mps": reals, -- m/s: stated cell, full width: the unit of scores
    "resolution_range_m": reals, -- m: so far from a stronger echo, in range, an echo has a cell of its own; absent: not known
    "resolution_range_rate_mps": reals, -- m/s: the same in range rate; absent: not known
    "azimuth_cell_rad": reals, -- rad: cell in azimuth of scores; absent: a twentieth of the field of view
    "carrier_hz": reals, -- Hz: carrier frequency
    "cycle_s": 'DOUBLE', -- s: time from scan to scan; absent: a scan in every frame
});

CREATE OR REPLACE MACRO contributors(folder, reals := 'DOUBLE') AS TABLE
FROM read_csv(folder || '/contributors.csv*', header = true, auto_detect = false, columns = {
    "detection_key": 'BIGINT', -- row of detections
    "contributor": 'BIGINT', -- place in the label, from 0; the leader of the cell is the first
    "object_key": 'BIGINT', -- row of objects
    "object": 'VARCHAR', -- id of the object
    "reflector": 'VARCHAR', -- name of the reflector in its set
    "path": 'VARCHAR', -- path of the echo's wave
    "mirror": 'VARCHAR', -- id of the object that mirrors, on paths by a wall
    "number": 'BIGINT', -- from 1, if there may be several that are else alike
    "range_m": reals, -- m: from the sensor to the reflector, exact
    "azimuth_rad": reals, -- rad: from boresight, positive to the left, exact
    "elevation_rad": reals, -- rad: from the horizontal, positive upwards, exact
    "range_rate_mps": reals, -- m/s: positive when receding, exact
    "ercs": reals, -- equivalent radar cross section in this direction
    "time_s": 'DOUBLE', -- s: instant of the measurement
    "weight": reals, -- share of the cell's amplitude
});

CREATE OR REPLACE MACRO sightings(folder, reals := 'DOUBLE') AS TABLE
FROM read_csv(folder || '/sightings.csv*', header = true, auto_detect = false, columns = {
    "scan_key": 'BIGINT', -- row of scans
    "object_key": 'BIGINT', -- row of objects
    "sensor": 'VARCHAR', -- name in the suite
    "object": 'VARCHAR', -- id of the object
    "reflectors": 'BIGINT', -- reflectors of it that the sensor looked for
    "in_range": 'BIGINT', -- of these, those that send towards the sensor and are in range
    "in_view": 'BIGINT', -- of these, those in the field of view
    "blocked_share": reals, -- share of these that a body hides
    "visibility": 'VARCHAR', -- share that is not hidden, in the levels of nuScenes; absent: none in view
    "detections": 'BIGINT', -- targets with an echo of it, where it is
    "merged": 'BIGINT', -- of the detections, those with an echo of something else
    "ghosts": 'BIGINT', -- targets with an echo of it by way of a mirror
});

CREATE OR REPLACE MACRO lost(folder, reals := 'DOUBLE') AS TABLE
FROM read_csv(folder || '/lost.csv*', header = true, auto_detect = false, columns = {
    "scan_key": 'BIGINT', -- row of scans
    "object_key": 'BIGINT', -- row of objects
    "sensor": 'VARCHAR', -- name in the suite
    "stage": 'VARCHAR', -- stage that lost them
    "reason": 'VARCHAR', -- why they are part of no target, or a word of the stage's own
    "effect": 'VARCHAR', -- effect to which the reason belongs
    "object": 'VARCHAR', -- id of the object
    "reflector": 'VARCHAR', -- name of the reflector in its set
    "path": 'VARCHAR', -- path of the echo's wave
    "mirror": 'VARCHAR', -- id of the object that mirrors, on paths by a wall
    "number": 'BIGINT', -- from 1, if there may be several that are else alike
    "range_m": reals, -- m: of the echo, or of a reflector without one
    "azimuth_rad": reals, -- rad: of the same
    "by": 'VARCHAR', -- id of the object that blocks it
    "shortfall_db": reals, -- dB: threshold over amplitude
    "margins_sight_m": reals, -- m: of range, view, visibility and sight lines; angles times range
    "margins_threshold_db": reals, -- dB: between the amplitude and the threshold
    "margins_leader_db": reals, -- dB: between two echoes of which the stronger opened a cell
    "margins_cell_edge": reals, -- from the border of a cell, in half cells
    "margins_sign": reals, -- sine of the phase between sum and delta; 0 is undecided
    "margins_limit_db": reals, -- dB: from the list's limit, in a list by amplitude
    "margins_limit_m": reals, -- m: from the list's limit, in a list by range
});

CREATE OR REPLACE MACRO frames(folder, reals := 'DOUBLE') AS TABLE
FROM read_csv(folder || '/frames.csv*', header = true, auto_detect = false, columns = {
    "frame_key": 'BIGINT', -- number of this row
    "scene": 'VARCHAR', -- unique in a set: source, ego, variant
    "frame": 'BIGINT', -- number in the scene, from 0
    "time_s": 'DOUBLE', -- s: end of the interval that the frame stands for
    "seed": 'UBIGINT', -- seed of all random numbers
    "interval_s": 'DOUBLE', -- s: length of that interval
    "last": 'BOOLEAN', -- is this the scene's last frame?
    "ego": 'VARCHAR', -- id of the object that carries the sensors
    "origin_x_m": 'DOUBLE', -- m: origin of the frame's coordinates in those of the source
    "origin_y_m": 'DOUBLE', -- m: origin of the frame's coordinates in those of the source
    "suite": 'VARCHAR', -- name of the suite document
    "objects": 'BIGINT', -- rows of objects of this frame
    "scans": 'BIGINT', -- rows of scans of this frame
    "detections": 'BIGINT', -- rows of detections of this frame
    "contributors": 'BIGINT', -- rows of contributors of this frame
    "sightings": 'BIGINT', -- rows of sightings of this frame
    "lost": 'BIGINT', -- rows of lost of this frame
});
