# Functions that the cases use beside the executables. Bash reads this file before every case (BASH_ENV).

# Writes the files that cases start from. objects.jsonl, reflectors.jsonl, echoes.jsonl, cells.jsonl
# and targets.jsonl have one frame each; scene.jsonl has a whole scene of six frames.
prepare() {
    cat >scene.json <<'END'
{
  "origin": "A car ahead of a standing observer, for tests.",
  "ego": "ego",
  "rate_hz": 25,
  "duration_s": 0.2,
  "objects": [
    {"id": "ego", "class": "car"},
    {"id": "car", "class": "box.json", "x_m": 15, "y_m": 1, "speed_mps": 3}
  ]
}
END
    cat >box.json <<'END'
{
  "origin": "For tests.",
  "length_m": 4,
  "width_m": 2,
  "height_m": 1.5,
  "reflectors": {
    "blocks": true,
    "points": [
      {"name": "left", "x": -0.5, "y": 0.5, "facing_rad": 3, "full_rad": 1, "zero_rad": 2, "ercs": 0.5},
      {"name": "right", "x": -0.5, "y": -0.5, "facing_rad": -3, "full_rad": 1, "zero_rad": 2, "ercs": 0.4}
    ],
    "planes": [
      {"name": "rear", "from_x": -0.5, "from_y": 0.5, "to_x": -0.5, "to_y": -0.5, "ercs": 0.7}
    ]
  }
}
END
    cat >suite.json <<'END'
{
  "origin": "One radar, for tests.",
  "sensors": [
    {
      "name": "front",
      "mount_x_m": 2, "mount_y_m": 0, "mount_yaw_rad": 0,
      "carrier_hz": 24e9,
      "range_min_m": 0.2, "range_max_m": 50,
      "field_of_view_rad": 3,
      "threshold_db": 6,
      "calibration_ercs": 0.8, "calibration_range_m": 50,
      "cell_range_m": 0.3, "cell_range_rate_mps": 0.5,
      "antenna_pattern": "dipole_pair",
      "phase_reference": "centre", "angle_estimator": "magnitude",
      "pointer_sigma": 0.5,
      "range_sigma_m": 0.02, "range_rate_sigma_mps": 0.05, "azimuth_sigma_rad": 0.04,
      "final_threshold": true,
      "list_order": "strongest", "list_limit": 10
    }
  ]
}
END
    printf '%s\n' azimuth_rad,sum,delta -1,0.2,-0.5 0,1,0 1,0.2,0.5 >pattern.csv
    printf '%s\n' range_m,level_db 1,30 10,10 100,-10 >levels.csv
    printf '%s\n' track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy,psi_rad,length,width \
        1,1,0,car,0,0,10,0,0,4,2 1,2,100,car,1,0,10,0,0,4,2 \
        2,1,0,car,20,0,10,0,0,4,2 2,2,100,car,21,0,10,0,0,4,2 >tracks.csv
    glint-traffic scene.json >scene.jsonl
    head -1 scene.jsonl >objects.jsonl
    glint-extract objects.jsonl >reflectors.jsonl
    glint-ideal --sensors suite.json --sections account reflectors.jsonl >echoes.jsonl
    glint-sensor echoes.jsonl >cells.jsonl
    glint-noise cells.jsonl >targets.jsonl
    glint-traffic tracks.csv --ego 1 >tracks.jsonl
    mkdir folder
}

# Plays scene.json with a road, on which the ego is, after a change of it by sed.
road() {
    local lane='{"offset_m": 9, "limit_mps": 20, "arrivals": [{"class": "car", "flow_per_h": 600, "spread": 0, "ego_m": 150}]}'
    sed "s/\"objects\": \\[\$/\"roads\": [{\"id\": \"r\", \"points\": [{\"x_m\": 0, \"y_m\": 0}, {\"x_m\": 200, \"y_m\": 0}], \"lanes\": [$lane]}], &/
        s/\"ego\": \"ego\"/\"ego\": \"me\"/; s/0\.2,/30,/" scene.json | sed "${1:-}" >bad.json
    glint-traffic bad.json
}

# Each function changes a good file by the sed expression $1 and runs the stage that reads such files.
frame() { sed -E "$1" objects.jsonl | glint-extract; }
reflectors() { sed -E "$1" reflectors.jsonl | glint-ideal --sensors suite.json; }
echoes() { sed -E "$1" echoes.jsonl | glint-sensor; }
cells() { sed -E "$1" cells.jsonl | glint-noise; }
targets() { sed -E "$1" targets.jsonl | glint-summary; }
# The cells of one column of a CSV table without quotes.
column() { awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) at = i } NR > 1 { print $at }'; }
scenario() { sed -E "$1" scene.json >bad.json; glint-traffic bad.json; }
suite() { sed -E "$1" suite.json >bad.json; glint-ideal --sensors bad.json reflectors.jsonl; }
vehicle() {
    sed -E "$1" box.json >bad.json
    sed 's/box.json/bad.json/' objects.jsonl | glint-extract
}
tracks() { sed -E "$1" tracks.csv >bad.csv; glint-traffic bad.csv --ego 1 --scene tracks/1; }

# Gives its arguments, as one line, to glint-extract.
line() { printf '%s\n' "$*" | glint-extract; }

# Runs a pipeline in bash and fused. Prints how their output or exit codes differ; returns the code.
both() {
    bash -o pipefail -c "$1" >piped.out 2>piped.err
    local piped=$?
    glint -c "$1" >fused.out 2>fused.err
    local fused=$?
    [ $piped = $fused ] || echo "piped ends with $piped, fused with $fused"
    cmp piped.out fused.out
    return $fused
}

# Runs a command with its standard output in a file, so that a transcript shows its messages alone.
quietly() { "$@" >quiet.out; }

# Runs a command and prints its messages and the number of lines that it writes.
count() {
    quietly "$@"
    local code=$?
    wc -l <quiet.out
    return $code
}
