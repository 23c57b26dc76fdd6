"""What the random worlds for simul-floorplan share: rows of their files, and their route and INI file."""


def row(word, *numbers):
    return " ".join([word] + [f"{n:.4f}" for n in numbers])


def write(draw, folder, name, plan, way, heading=0, speed=0.8, slips=()):
    """Writes FOLDER/NAME.plan, .route and .ini. Spacing of the scans, noise and errors of the odometry are drawn.

    way: points (m); heading: of the robot at the first, deg; slips: as in [odometry].
    """
    path = f"{folder}/{name}"
    with open(path + ".plan", "w") as f:
        f.write("\n".join(plan) + "\n")
    with open(path + ".route", "w") as f:
        start = [row("start", *way[0], heading), f"speed {speed}", "turn_speed 40"]
        f.write("\n".join(start + [row("go", *place) for place in way[1:]]) + "\n")
    with open(path + ".ini", "w") as f:
        f.write(f"""[simulation]
plan = {name}.plan
route = {name}.route
seed = {name.split("-")[-1]}

[laser]
sensor = LMS-200
resolution_deg = 1
rate = {draw.choice([1, 2, 4])}
mixed_pixels = true

[odometry]
mean_d_d = {draw.uniform(0.97, 1.03):.3f}
mean_t_d_deg = {draw.uniform(-0.4, 0.4):.2f}
mean_t_t = {draw.uniform(0.96, 1.04):.3f}
sigma_d_d = {draw.choice([0.02, 0.05])}
sigma_t_d_deg = {draw.choice([0.5, 1, 2])}
slips = {", ".join(slips)}
""")
