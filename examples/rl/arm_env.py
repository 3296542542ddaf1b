"""Many flexible arms as an environment to learn in: no two are alike, and all step at once.

    tmm-gen build examples/jax/arm.toml --out out/arms
    PYTHONPATH=out/arms python examples/rl/arm_env.py

Each episode draws stiffness and payload of its arm anew; the task is to bring the tip to an angle of one radian and
hold it there. Methods and results are those of ``gymnasium.vector.VectorEnv`` (next-step autoreset), whose package is
not needed.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from arm import jax_kernel as arm

Array = Any


class ArmEnv:
    """So many arms, each an environment.

    Parameters
    ----------
    num_envs : int
        How many.
    stiffness, payload : float
        By how much these are drawn to either side of the scene's, relative to it.
    target : float
        Angle to reach, rad.
    torque : float
        Of the motor at most, N m; an action from -1 to 1 is a part of it.
    substeps : int
        Steps of the kernel for which an action is held.
    seconds : float
        After which an episode ends.
    """

    def __init__(
        self,
        num_envs: int,
        *,
        stiffness: float = 0.2,
        payload: float = 0.5,
        target: float = 1.0,
        torque: float = 3.0,
        substeps: int = 4,
        seconds: float = 2.0,
    ) -> None:
        self.num_envs = num_envs
        self.observation_shape, self.action_shape = (6,), (1,)
        self._limit = round(seconds / (substeps * arm.STEP))
        self._spread, self._target, self._torque = (stiffness, payload), target, torque
        self._start = jax.jit(jax.vmap(self._drawn))
        self._advance = jax.jit(jax.vmap(partial(self._held, substeps)))

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Array, dict[str, Any]]:
        """Draw all arms anew, at rest; return what is observed, shape (num_envs, 6), and nothing more."""
        del options
        entropy = np.random.SeedSequence(seed).generate_state(1)[0]
        self._key = jax.random.key(entropy)
        self._model, self._state = self._start(self._keys())
        self._count = np.zeros(self.num_envs, int)
        self._over = np.zeros(self.num_envs, bool)
        return np.asarray(jax.vmap(self._observed)(self._model, self._state)), {}

    def step(self, actions: Array) -> tuple[Array, Array, Array, Array, dict[str, Any]]:
        """Hold an action, shape (num_envs, 1), for each arm.

        Returns
        -------
        observations, rewards, terminated, truncated, info
            An arm whose motion cannot be followed is terminated; one whose time is up is truncated; its next step
            begins another episode, whatever the action.
        """
        torque = self._torque * jnp.clip(jnp.asarray(actions)[:, 0], -1.0, 1.0)
        state, seen, rewards = self._advance(self._model, self._state, torque)
        if self._over.any():
            fresh = self._start(self._keys())
            over = jnp.asarray(self._over)
            self._model, state = jax.tree.map(
                lambda new, old: jnp.where(over.reshape(-1, *[1] * (old.ndim - 1)), new, old),
                fresh,
                (self._model, state),
            )
            seen = jnp.where(over[:, None], jax.vmap(self._observed)(self._model, state), seen)
            rewards = jnp.where(over, 0.0, rewards)
        self._state = state
        self._count = np.where(self._over, 0, self._count + 1)
        observations = np.asarray(seen)
        terminated = ~np.isfinite(observations).all(axis=1)
        truncated = self._count >= self._limit
        self._over = terminated | truncated
        rewards = np.where(terminated, -100.0, np.asarray(rewards))
        return np.nan_to_num(observations), rewards, terminated, truncated, {}

    def _keys(self) -> Array:
        self._key, now = jax.random.split(self._key)
        return jax.random.split(now, self.num_envs)

    def _drawn(self, key: Array) -> tuple[Array, Array]:
        """Return model and state of one arm."""
        stiffness, payload = 1.0 + jnp.array(self._spread) * jax.random.uniform(key, (2,), minval=-1.0)
        usual = arm.Params()
        params = replace(
            usual,
            stiffness=usual.stiffness * stiffness,
            damping=usual.damping * stiffness,
            tip_mass=usual.tip_mass * payload,
        )
        return arm.prepare(params), arm.initialise(params)

    def _held(self, substeps: int, model: Array, state: Array, torque: Array) -> tuple[Array, Array, Array]:
        """Return one arm's state, what is observed, and the reward."""
        acting = arm.Input(hub_torque=torque)
        state, _ = jax.lax.scan(lambda s, _: (arm.step(model, s, acting), None), state, length=substeps)
        seen = self._observed(model, state)
        missed = (seen[2] - jnp.cos(self._target)) ** 2 + (seen[3] - jnp.sin(self._target)) ** 2
        return state, seen, -missed - 1e-3 * seen[1] ** 2 - 1e-4 * torque**2

    def _observed(self, model: Array, state: Array) -> Array:
        """Return hub angle and rate, place of the tip, and how far the hub is from the target."""
        found = arm.output(model, state)
        ahead = self._target - found.hub
        return jnp.stack(
            [found.hub, found.hub_rate, found.tip_x, found.tip_y, jnp.sin(ahead), jnp.cos(ahead)]
        )


def main() -> None:
    """Try a proportional controller with damping on a thousand arms."""
    env = ArmEnv(1000)
    seen, _ = env.reset(seed=1)
    total = np.zeros(env.num_envs)
    for _ in range(99):
        action = (4.0 * (1.0 - seen[:, 0]) - 1.2 * seen[:, 1]) / 3.0
        seen, rewards, terminated, _, _ = env.step(action[:, None])
        total += rewards
        assert not terminated.any()
    off = np.hypot(seen[:, 2] - np.cos(1.0), seen[:, 3] - np.sin(1.0))
    print(f"{env.num_envs} arms: reward {total.mean():.2f} on average, {total.min():.2f} at worst")
    print(f"tip {1e3 * off.mean():.1f} mm off on average after 2 s, {1e3 * off.max():.1f} mm at worst")


if __name__ == "__main__":
    main()
