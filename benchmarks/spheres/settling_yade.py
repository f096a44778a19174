"""The grains of benchmarks/spheres/main.cpp in YADE; prints the seconds of 200 steps after 500. Run by yade, which brings the names."""

import time
from math import atan

# pylint: disable=undefined-variable
rows = [[float(word) for word in line.split()] for line in open("start.txt", encoding="utf-8")]
length = float(open("length.txt", encoding="utf-8").read())
O.materials.append(FrictMat(young=1e8, poisson=0.3, frictionAngle=atan(0.5), density=2500))
O.periodic = True
O.cell.setBox(length, length, 3 * length)
for radius, x, y, z, vx, vy, vz in rows:
    number = O.bodies.append(sphere((x, y, z + 0.5 * length), radius))
    O.bodies[number].state.vel = (vx, vy, vz)
O.bodies.append(box((0.5 * length, 0.5 * length, 0.5 * length - 1e-3), (length, length, 1e-3), fixed=True))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Box_Aabb()], verletDist=5e-5, allowBiggerThanPeriod=True),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Box_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_MindlinPhys(en=0.7, es=0.7)],
                    [Law2_ScGeom_MindlinPhys_Mindlin()]),
    NewtonIntegrator(gravity=(0, 0, -9.81), damping=0),
]
O.dt = 2e-6
O.run(500, True)
began = time.time()
O.run(200, True)
print("seconds", time.time() - began, flush=True)
