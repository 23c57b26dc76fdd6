"""People who walk around a robot, as its laser would have seen them."""
import math

SPEED = 0.8  # m/s
LEG = 0.08  # m, radius
STRIDE, WIDTH = 0.12, 0.12  # m, of a leg from the middle, along and across
NEAREST, FARTHEST, LEFT_BEHIND = 0.6, 5, 7  # m from the robot


class Crowd:
    """Walks from one random place around the robot to the next; who is left behind comes back elsewhere."""

    def __init__(self, count, draw):
        self.people, self.count, self.draw, self.time = [], count, draw, None

    def place(self, robot, nearest):
        angle, distance = self.draw.uniform(-math.pi, math.pi), self.draw.uniform(nearest, FARTHEST)
        return robot[0] + distance * math.cos(angle), robot[1] + distance * math.sin(angle)

    def walk(self, robot, time):
        step = SPEED * min(max(time - self.time, 0), 5) if self.people else 0
        self.time = time
        while len(self.people) < self.count:
            self.people.append((self.place(robot, 1), self.place(robot, NEAREST)))
        for i, (at, goal) in enumerate(self.people):
            if math.dist(at, robot[:2]) > LEFT_BEHIND:
                at, goal = self.place(robot, 3), self.place(robot, NEAREST)
            left = math.dist(at, goal)
            if left <= step:
                at, goal = goal, self.place(robot, NEAREST)
            else:
                at = tuple(a + step * (g - a) / left for a, g in zip(at, goal))
            distance = math.dist(at, robot[:2])
            if 0 < distance < NEAREST:
                at = tuple(r + (a - r) * NEAREST / distance for a, r in zip(at, robot))
            self.people[i] = at, goal

    def legs(self):
        for at, goal in self.people:
            heading = math.atan2(goal[1] - at[1], goal[0] - at[0])
            stride = STRIDE * math.cos(6 * self.time)
            for side in (-1, 1):
                yield (at[0] + side * (stride * math.cos(heading) - WIDTH * math.sin(heading)),
                       at[1] + side * (stride * math.sin(heading) + WIDTH * math.cos(heading)))

    def hide(self, ranges, robot, time):
        """Returns the ranges of a scan of 180 deg at (x, y, heading) with the legs of the people."""
        self.walk(robot, time)
        seen, step = list(ranges), math.pi / (180 if len(ranges) < 200 else 360)
        for leg in self.legs():
            distance = math.dist(leg, robot[:2])
            if distance <= LEG:
                continue
            bearing = math.remainder(math.atan2(leg[1] - robot[1], leg[0] - robot[0]) - robot[2], math.tau)
            half = math.asin(LEG / distance)
            first, last = ((bearing + side * half + math.pi / 2) / step for side in (-1, 1))
            for i in range(max(0, math.ceil(first)), min(len(seen) - 1, math.floor(last)) + 1):
                angle = i * step - math.pi / 2 - bearing
                hit = distance * math.cos(angle) - math.sqrt(max(0, LEG ** 2 - (distance * math.sin(angle)) ** 2))
                seen[i] = min(seen[i], hit + self.draw.gauss(0, 0.01))
        return seen
