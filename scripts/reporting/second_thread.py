"""Where the second thread's time goes: the time of both threads in a frame, divided into useful work and losses."""
from dataclasses import dataclass

from bench_rows import parse_name
from noise import interval, median, paired_order, ratios
from tables import percent

TARGET = 1.9  # the speed-up that a second thread should give
SHORT_MS = 2.0  # on one thread: starting a thread matters most in frames up to this

LOSSES = {
    "slower": "slower tasks",
    "serial": "serial code",
    "start": "start of sections",
    "between": "between tasks",
    "turn": "in-order turn",
    "end": "end of sections",
}


@dataclass
class Division:
    """Of a scene's frame. `losses` are shares of the time of both threads; the rest is useful work. Where tasks are faster on
    two threads, "slower" is 0, and the other losses add up to more than the speed-up lacks."""
    scene: str
    rounds: dict

    @property
    def speed_ups(self):
        return ratios(self.rounds["two_ms"], self.rounds["one_ms"])

    @property
    def speed_up(self):
        return median(self.speed_ups)

    @property
    def interval(self):
        return interval(self.speed_ups)

    @property
    def order(self):
        """1 if the rounds settle that the speed-up is above TARGET, -1 if below, 0 if they settle neither."""
        return -paired_order([ms / TARGET for ms in self.rounds["one_ms"]], self.rounds["two_ms"])

    @property
    def losses(self):
        waits = {cause: median([wait / (2 * two) for wait, two in zip(self.rounds[f"{cause}_ms"], self.rounds["two_ms"])])
                 for cause in LOSSES if cause != "slower"}
        return {"slower": max(0.0, 1 - self.speed_up / 2 - sum(waits.values())), **waits}


def divisions(bench):
    """Of frames that are not short."""
    return [Division(parse_name(name).scene, rounds) for name, rounds in bench.second_thread.items()
            if median(rounds["one_ms"]) > SHORT_MS]


def second_thread_sentence(found):
    """Which scenes reach TARGET, and what the others lose most to."""
    def of(order, loss):
        for division in found:
            if division.order == order:
                cause = max(division.losses, key=division.losses.get)
                yield (f"`{division.scene}` {division.speed_up:.2f}×"
                       + (f" (largest loss: {LOSSES[cause]}, {percent(division.losses[cause])})" if loss else ""))

    groups = ((f"above {TARGET}×", of(1, False)), (f"below {TARGET}×", of(-1, True)), ("not settled", of(0, True)))
    said = [f"{verdict}: {', '.join(scenes)}" for verdict, names in groups if (scenes := list(names))]
    return (f"Speed-up by a second thread of the whole frames of `tiled` that take more than {SHORT_MS:g} ms on one, "
            f"{'; '.join(said)}.")
