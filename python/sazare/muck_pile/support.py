"""Which bodies are still in the air: those that nothing holds up."""

import numpy as np

from sazare.muck_pile.balls import near_pairs

REACH = 0.05  # of the radii: spheres that are nearer touch, since piles that settle leave their contacts again and again
CARRIED = 0.5  # of the weight of a body: what carries less of it lets it fall
ROUND_OFF = 1e-6  # of the speed


def carried_shares(before, after, gravity):
    """Share of the weight of bodies (m,) that something carried on average between two Landed: 1 + dv_z/(g dt), 0 in free fall, 1 at rest; 0 where the
    interval is too short to tell them from each other."""
    gained = gravity * (after.time - before.time)
    if not gained > 0.0:
        return np.zeros(len(after.velocities))
    known = CARRIED * gained > ROUND_OFF * np.linalg.norm(after.velocities, axis=1)
    return np.where(known, 1.0 + (after.velocities[:, 2] - before.velocities[:, 2]) / gained, 0.0)


def in_the_air(model, before, after):
    """Which bodies (m,) are in the air at the later of two Landed.

    What lies touches the ground or the rock that stays, directly or through others that lie. CARRIED of its weight or more was carried over the interval, or it is so slow
    that it jumps by REACH of its size at most; and it does not rise so fast that it jumps higher than its size. All else flies, however slow it is at the top of its
    flight. Fines meet nothing and fly as long as their parabola says.
    """
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    count = len(model.bodies)
    jump = 2.0 * model.gravity * model.bodies.sizes
    rises = np.maximum(after.velocities[:, 2], 0.0) ** 2 > jump
    slow = np.sum(after.velocities**2, axis=1) <= REACH * jump
    held = ((carried_shares(before, after, model.gravity) >= CARRIED) | slow) & ~rises & ~model.fines
    balls = after.balls.of(held[after.balls.body])
    first, second, _ = near_pairs(balls, (1.0 + REACH) * balls.radii) if len(balls) else (np.zeros(0, dtype=int),) * 3
    on_base = balls.body[_touches_base(model, balls)]
    begin = np.concatenate([balls.body[first], on_base])
    end = np.concatenate([balls.body[second], np.full(len(on_base), count)])
    links = coo_matrix((np.ones(len(begin)), (begin, end)), shape=(count + 1, count + 1))
    _, part = connected_components(links, directed=False)
    flies = ~(held & (part[:-1] == part[-1]))
    return np.where(model.fines, np.abs(after.velocities[:, 2]) > 0.0, flies)


def _touches_base(model, balls):
    """Which balls (n,) touch the ground or the rock that stays, or are in it."""
    reach = (1.0 + REACH) * balls.radii
    touches = balls.centres[:, 2] - model.ground <= reach
    rest = np.flatnonzero(~touches)
    if len(rest) and model.standing:
        centres = balls.centres[rest]
        touches[rest] = (model.standing.distance(centres) <= reach[rest]) | model.standing.holds(centres)
    return touches
