"""Which torques, and how stiff an arm, bring its tip to rest soonest? Derivatives through time tell.

    tmm-gen build examples/jax/arm.toml --out out/arms
    PYTHONPATH=out/arms python examples/jax/swing.py

A swing by one radian in a horizontal plane, in 0.6 s: the cost is how far the tip is from its place, and how fast it
moves, in the last tenth of a second, with a little for torque. One run backward gives its derivatives by all 120
torques and by the five stiffnesses.
"""

from __future__ import annotations

from dataclasses import replace

import jax
import jax.numpy as jnp
import numpy as np
from arm import jax_kernel as arm

jax.config.update("jax_enable_x64", True)

STEPS, LAST = 120, 20
HELD = 6  # steps for which a torque is held
TARGET = jnp.array([jnp.cos(1.0), jnp.sin(1.0)])


def cost(torques: jax.Array, softness: jax.Array) -> jax.Array:
    """Return what a swing costs; softness is the logarithm of each joint's stiffness over the scene's."""
    params = arm.Params()
    params = replace(params, stiffness=params.stiffness * jnp.exp(softness))
    found, _ = arm.simulate(STEPS, arm.Input(hub_torque=jnp.repeat(torques, HELD)), params)
    tip = jnp.stack([found.tip_x, found.tip_y], axis=1)
    missed = jnp.sum((tip[-LAST:] - TARGET) ** 2)
    moved = jnp.sum((jnp.diff(tip[-LAST:], axis=0) / arm.STEP) ** 2)
    return missed + 0.01 * moved + 1e-4 * jnp.sum(torques**2) + 0.01 * jnp.sum(softness**2)


def main(turns: int = 150) -> None:
    """Descend along the gradient, each number by its own scale (Adam), and print what is gained."""
    gradient = jax.jit(jax.value_and_grad(cost, argnums=(0, 1)))
    links = arm.STATIONS
    at = (jnp.zeros(STEPS // HELD).at[:10].set(1.0).at[10:].set(-1.0), jnp.zeros(links))
    first, slopes = gradient(*at)

    size = 1e-4
    for name, place in (("torque", 0), ("softness", 1)):
        up, down = (
            gradient(*(x.at[2].add(d) if k == place else x for k, x in enumerate(at)))[0]
            for d in (size, -size)
        )
        print(f"by {name} 3: {slopes[place][2]:.6f}, by differences {(up - down) / (2 * size):.6f}")

    mean, square = [[jnp.zeros_like(x) for x in at] for _ in range(2)]
    for turn in range(1, turns + 1):
        _, slopes = gradient(*at)
        mean = [0.9 * m + 0.1 * g for m, g in zip(mean, slopes, strict=True)]
        square = [0.99 * s + 0.01 * g * g for s, g in zip(square, slopes, strict=True)]
        at = tuple(
            x - 0.1 * (m / (1 - 0.9**turn)) / (jnp.sqrt(s / (1 - 0.99**turn)) + 1e-9)
            for x, m, s in zip(at, mean, square, strict=True)
        )
    last, _ = gradient(*at)
    print(f"cost {first:.3f} before, {last:.4f} after; stiffness times {np.exp(at[1]).round(2)}")


if __name__ == "__main__":
    main()
