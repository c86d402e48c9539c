"""scripts/bench --tables: what recorded traffic costs, from the table to frames.

Tables are written by this file, in the layouts of inD, INTERACTION, SUMO and esmini: vehicles on parallel roads, 40 m
apart, so that the density is the same whatever their number. Reading a table to rows in memory is compared with
libcsv whose callback turns the same cells into numbers by from_chars (read_table.c). Frames are those of all vehicles
with --radius-m 100.
"""
import math
import os
import statistics
import subprocess

import timing
from glint.progress import say

RATE_HZ = 25
ROADS_M = 40
PER_ROAD = 50
RADIUS_M = 100
ROUNDS = 5
HEADERS = {
    "ind": ("recordingId,trackId,frame,trackLifetime,xCenter,yCenter,heading,width,length,xVelocity,yVelocity,"
            "xAcceleration,yAcceleration,lonVelocity,latVelocity,lonAcceleration,latAcceleration"),
    "interaction": "track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy,psi_rad,length,width",
    "sumo": ("timestep_time;vehicle_angle;vehicle_id;vehicle_lane;vehicle_pos;vehicle_slope;vehicle_speed;vehicle_type;"
             "vehicle_x;vehicle_y"),
}
# The columns of numbers that glint's reader takes, each between separators.
NUMBERS = {
    "ind": ",frame,xCenter,yCenter,heading,width,length,xVelocity,yVelocity,",
    "interaction": ",timestamp_ms,x,y,vx,vy,psi_rad,length,width,",
    "sumo": ";timestep_time;vehicle_x;vehicle_y;vehicle_angle;vehicle_speed;",
}


def state(vehicle, frame):
    """Place, velocity and heading, in metres and degrees."""
    time_s = frame / RATE_HZ
    x = 13.37 + ROADS_M * (vehicle % PER_ROAD) + 13.7 * time_s + 1.5 * math.sin(time_s + vehicle)
    y = 37.31 + ROADS_M * (vehicle // PER_ROAD) + math.sin(0.5 * time_s + vehicle)
    vx, vy = 13.7 + 1.5 * math.cos(time_s + vehicle), 0.5 * math.cos(0.5 * time_s + vehicle)
    return x, y, vx, vy, math.degrees(math.atan2(vy, vx))


def row(layout, vehicle, frame):
    x, y, vx, vy, deg = state(vehicle, frame)
    if layout == "ind":
        return (f"10,{vehicle},{frame},{frame},{x:.5f},{y:.5f},{deg % 360:.5f},1.80000,4.50000,{vx:.5f},{vy:.5f},"
                f"{-vy:.5f},{vy:.5f},{vx:.5f},{vy:.5f},{-vy:.5f},0.00000\n")
    if layout == "interaction":
        return (f"{vehicle},{frame + 1},{1000 * frame // RATE_HZ},car,{x:.3f},{y:.3f},{vx:.3f},{vy:.3f},"
                f"{math.radians(deg):.3f},4.50,1.80\n")
    return (f"{frame / RATE_HZ:.2f};{90 - deg:.6f};{vehicle};a_{vehicle % 3};{x:.6f};0.000000;{math.hypot(vx, vy):.6f};"
            f"passenger;{x:.6f};{y:.6f}\n")


def write(folder, layout, vehicles, frames):
    """Writes a table: by time in SUMO's layout, by track in the others."""
    folder = os.path.join(folder, f"{layout}-{vehicles}x{frames}")
    os.makedirs(folder, exist_ok=True)
    path = os.path.join(folder, "10_tracks.csv")
    if os.path.exists(path):
        return path
    with open(os.path.join(folder, "10_recordingMeta.csv"), "w", encoding="ascii") as file:
        file.write(f"recordingId,frameRate\n10,{RATE_HZ}\n")
    with open(os.path.join(folder, "10_tracksMeta.csv"), "w", encoding="ascii") as file:
        file.write("trackId,class\n" + "".join(f"{vehicle},car\n" for vehicle in range(vehicles)))
    with open(path, "w", encoding="ascii") as file:
        file.write(HEADERS[layout] + "\n")
        if layout == "sumo":
            file.writelines(row(layout, vehicle, frame) for frame in range(frames) for vehicle in range(vehicles))
        else:
            file.writelines(row(layout, vehicle, frame) for vehicle in range(vehicles) for frame in range(frames))
    return path


def reading(folder):
    """Tables to rows in memory, beside libcsv with from_chars."""
    say("  ns a row   libcsv and from_chars   their ratio   layout")
    for layout in HEADERS:
        path = write(folder, layout, 400, 500)
        done = subprocess.run([os.path.join(timing.TOOLS, "read_table"), str(ROUNDS), path, NUMBERS[layout]], check=True,
                              stdout=subprocess.PIPE, text=True)
        times = {}
        for line in done.stdout.splitlines():
            name, ns = line.split("\t")
            times.setdefault(name, []).append(float(ns))
        ours, plain = (statistics.median(times[name]) for name in ("table", "libcsv with from_chars"))
        say(f"{ours:10.0f} {plain:23.0f} {plain / ours:13.2f}   {layout}")


def frames_of(glint, folder, path):
    """What glint tells of its times, and the peak of its memory, while it writes the frames of everybody."""
    command = f"glint-traffic {path} --ego all --radius-m {RADIUS_M}"
    return timing.timed(glint, timing.write_text(command, folder))


def all_egos(glint, folder):
    """One reading, a scene for each vehicle; and tables of a tenth of it, for the memory of a row."""
    say("\n   rows   egos   us a frame   to writing it   peak MB   layout")
    for layout in ("ind", "sumo"):
        peaks = {}
        for vehicles, frames in ((2000, 50), (2000, 500)):
            told = frames_of(glint, folder, write(folder, layout, vehicles, frames))
            source, writing = (told[part]["ns_per_frame"] for part in ("traffic", "write"))
            rows = vehicles * frames
            peaks[rows] = told["spent"]["peak_kB"] * 1024
            say(f"{rows:7} {vehicles:6} {(source + writing) / 1e3:12.1f} {(source + writing) / writing:15.2f} "
                f"{peaks[rows] / 1e6:9.1f}   {layout}")
        (few, low), (many, high) = peaks.items()
        say(f"{(high - low) / (many - few):7.1f} bytes more for each row")


def curve(glint, folder):
    say("\nvehicles   us a frame   objects in it")
    for vehicles in (100, 1000, 10000):
        path = write(folder, "ind", vehicles, 200000 // vehicles)
        told = frames_of(glint, folder, path)
        text = subprocess.run([glint, "-c", f"glint-traffic {path} --ego all --radius-m {RADIUS_M} --to-s 0"], check=True,
                              stdout=subprocess.PIPE).stdout
        cost = sum(told[part]["ns_per_frame"] for part in ("traffic", "write"))
        say(f"{vehicles:8} {cost / 1e3:12.1f} {text.count(b'length_m') / text.count(b'ego'):15.1f}")


def run(options, folder):
    reading(folder)
    all_egos(options.glint, folder)
    curve(options.glint, folder)
