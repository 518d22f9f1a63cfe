#!/usr/bin/env python3
"""A board in Python, written from runtime/devices/board/README.md alone: the second implementation of the protocol.

    peer.py --unix PATH     listens on a Unix socket and serves one host
    peer.py --pty           opens a pseudo-terminal, prints the path of its far end, and serves that
    peer.py --arm …         the same with two axes

Its handle moves by itself: 3 counts a sample upwards until 500, then down again, and so on; each joint of the arm
likewise, from where it is when switched on. In the end it prints what the host has left it with.
"""
import argparse
import math
import os
import select
import socket
import struct
import sys
import time
import tty

VERSION = 1
HELLO, DESCRIPTION, CONFIGURE, CONFIGURED = 0x0F, 0x96, 0x33, 0x99
RESET, COMMAND, SAMPLE, ASK_STATISTICS, STATISTICS = 0x3C, 0x55, 0xA5, 0x5A, 0xC3
ARM_DESCRIPTION, ARM_CONFIGURE, ARM_COMMAND, ARM_SAMPLE = 0x66, 0x69, 0xAA, 0xCC
LENGTH = {HELLO: 0, DESCRIPTION: 41, CONFIGURE: 16, CONFIGURED: 3, RESET: 2, COMMAND: 8, SAMPLE: 36,
          ASK_STATISTICS: 0, STATISTICS: 44, ARM_DESCRIPTION: 64, ARM_CONFIGURE: 32, ARM_COMMAND: 24, ARM_SAMPLE: 64}
IDLE, RUNNING, SAFE = 0, 1, 2
HOST_SILENT, BAD_COMMAND, COMMANDS_ANEW = 1, 2, 6
ON_COMMAND, FREE_RUNNING = 0, 1
HOST, OWN_MODEL = 0, 1
ACCEPTED, PERIOD_TOO_SHORT, WATCHDOG_NEEDED, DAMPING_OUT_OF_RANGE, NO_MODEL = range(5)
NO_SUCH_CHOICE, SPEED_LIMIT_WRONG = 6, 7

SHORTEST_PERIOD = 500_000  # [ns]


class Handle:
    """What a board of one axis drives, and its messages."""
    description, configure, command, sample = DESCRIPTION, CONFIGURE, COMMAND, SAMPLE
    motion, name_size = 0, 16
    encoder_steps = [1e-5]  # [m]
    max_torques = [50.0]  # [N]
    max_dampings = [30.0]  # [N s/m]
    power_on_dampings = [5.0]  # [N s/m]
    first_counts = [0]


class Arm:
    """The same with two axes, of them two brakes."""
    description, configure, command, sample = ARM_DESCRIPTION, ARM_CONFIGURE, ARM_COMMAND, ARM_SAMPLE
    motion, name_size = 1, 15
    encoder_steps = [2 * math.pi / 65536] * 2  # [rad]
    max_torques = [0.5] * 2  # [N m]
    max_dampings = [0.05, 0.05, 0.0, 0.0]  # [N m s/rad]
    power_on_dampings = [0.003, 0.003, 0.0, 0.0]  # [N m s/rad]
    first_counts = [24384, 8384]


def crc16(data):
    rest = 0xFFFF
    for byte in data:
        rest ^= byte
        for _ in range(8):
            rest = (rest >> 1) ^ 0x8408 if rest & 1 else rest >> 1
    return rest ^ 0xFFFF


def frame(kind, payload=b"", sequence=0):
    body = struct.pack("<BBBI", VERSION, kind, len(payload), sequence) + payload
    return b"\x64\x70" + body + struct.pack("<H", crc16(body))


class Decoder:
    def __init__(self):
        self.buffer = bytearray()
        self.received = self.corrupted = self.discarded = self.foreign = 0

    def feed(self, data):
        """Yields (type, sequence, payload) of every intact frame."""
        self.buffer += data
        while self.buffer:
            size = self.size_of_first()
            if size is None:
                self.discard()
            elif len(self.buffer) < size:
                return
            elif crc16(self.buffer[2:size - 2]) != int.from_bytes(self.buffer[size - 2:size], "little"):
                self.corrupted += 1
                self.discard()
            else:
                whole = bytes(self.buffer[:size])
                del self.buffer[:size]
                if whole[2] != VERSION:
                    self.foreign += 1
                    continue
                self.received += 1
                yield whole[3], struct.unpack_from("<I", whole, 5)[0], whole[9:-2]

    def size_of_first(self):
        """Bytes of the frame that begins here, as far as one can tell; None where none does."""
        head = self.buffer
        if not b"\x64\x70".startswith(head[:2]):
            return None
        if len(head) < 5:
            return 5
        if head[4] != LENGTH.get(head[3]) if head[2] == VERSION else head[4] > 64:
            return None
        return 9 + head[4] + 2

    def discard(self):
        self.discarded += 1
        del self.buffer[:1]


class Sequence:
    NEW, OLD, ANEW = range(3)

    def __init__(self):
        self.lost = self.repeated = self.late = 0
        self.restart()

    def restart(self):
        self.newest, self.seen, self.run = None, set(), []

    def note(self, number):
        """Whether a command with this number is new, old, or the first of a peer that has begun to count anew."""
        ahead = 1 if self.newest is None else (number - self.newest) & 0xFFFFFFFF
        behind = -ahead & 0xFFFFFFFF
        if 0 < ahead <= 1024:
            self.lost += ahead - 1
            self.newest, self.run = number, []
            self.seen = {old for old in self.seen if (number - old) & 0xFFFFFFFF < 32} | {number}
            return self.NEW
        if behind < 32:
            if number in self.seen:
                self.repeated += 1
            else:
                self.late += 1
                self.lost -= 1
                self.seen.add(number)
            return self.OLD
        self.run = self.run + [number] if self.run and number == (self.run[-1] + 1) & 0xFFFFFFFF else [number]
        if len(self.run) < 4:
            self.late += 1
            return self.OLD
        self.lost += max(ahead - 4, 0) if ahead < 1 << 31 else 0
        self.newest, self.seen, self.run = number, {number}, []
        return self.ANEW


class Board:
    def __init__(self, send, drives):
        self.send = send
        self.drives = drives
        self.joints, self.brakes = len(drives.max_torques), len(drives.max_dampings)
        self.decoder = Decoder()
        self.commands = Sequence()
        self.state, self.cause, self.stops = IDLE, 0, 0
        self.configured = False
        self.safe_dampings = drives.power_on_dampings
        self.torques, self.dampings = [0.0] * self.joints, self.safe_dampings
        self.period, self.watchdog_periods, self.sampling = 1_000_000, 0, ON_COMMAND
        self.silence_left = None  # periods until the watchdog bites; None: it waits for nothing
        self.samples = 0

    def take(self, data):
        drives, joints, brakes = self.drives, self.joints, self.brakes
        for kind, sequence, payload in self.decoder.feed(data):
            if kind == HELLO:
                self.send(frame(drives.description,
                                struct.pack(f"<{joints}d{joints}f{brakes}fIIB{drives.name_size}s",
                                            *drives.encoder_steps,
                                            *drives.max_torques, *drives.max_dampings, SHORTEST_PERIOD, 0,
                                            drives.motion,
                                            b"peer.py")))
            elif kind == drives.configure:
                period, *numbers = struct.unpack(f"<I{brakes}f{joints}fHBB", payload)
                self.configure(period, numbers[:brakes], numbers[brakes:brakes + joints], *numbers[brakes + joints:])
            elif kind == RESET:
                self.reset(*struct.unpack("<H", payload))
            elif kind == drives.command:
                numbers = struct.unpack(f"<{joints}f{brakes}f", payload)
                self.command(sequence, numbers[:joints], numbers[joints:])
            elif kind == ASK_STATISTICS:
                heard, obeyed = self.decoder, self.commands
                self.send(frame(STATISTICS, struct.pack("<11I", heard.received, heard.corrupted, heard.discarded,
                                                        heard.foreign, obeyed.lost, obeyed.repeated, obeyed.late,
                                                        0, 0, 0, 0)))

    def configure(self, period, safe_dampings, speed_limits, watchdog_periods, sampling, controller):
        self.stop(IDLE, 0)
        if (sampling, controller) not in ((ON_COMMAND, HOST), (FREE_RUNNING, HOST), (FREE_RUNNING, OWN_MODEL)):
            verdict = NO_SUCH_CHOICE
        elif period < SHORTEST_PERIOD:
            verdict = PERIOD_TOO_SHORT
        elif not all(0 <= safe <= most for safe, most in zip(safe_dampings, self.drives.max_dampings)):
            verdict = DAMPING_OUT_OF_RANGE
        elif not all(limit >= 0 and math.isfinite(limit) for limit in speed_limits):
            verdict = SPEED_LIMIT_WRONG
        elif controller == OWN_MODEL:
            verdict = NO_MODEL
        else:
            verdict = ACCEPTED if watchdog_periods else WATCHDOG_NEEDED
        self.configured = verdict == ACCEPTED
        if self.configured:
            self.period, self.watchdog_periods, self.sampling = period, watchdog_periods, sampling
            self.safe_dampings = self.dampings = safe_dampings
            self.commands.restart()
        self.send(frame(CONFIGURED, struct.pack("<BH", verdict, self.stops)))

    def reset(self, stops):
        if self.configured and self.state != RUNNING and stops == self.stops:
            self.state = RUNNING
            self.silence_left = None
        self.sample()

    def command(self, sequence, torques, dampings):
        came = self.commands.note(sequence)
        if came == Sequence.OLD:
            return
        if self.state == RUNNING and came == Sequence.ANEW:
            self.stop(SAFE, COMMANDS_ANEW)
        elif self.state == RUNNING:
            self.silence_left = self.watchdog_periods
            if all(map(math.isfinite, torques + dampings)):
                self.torques = [min(max(wish, -most), most) for wish, most in zip(torques, self.drives.max_torques)]
                self.dampings = [min(max(wish, 0.0), most) for wish, most in zip(dampings, self.drives.max_dampings)]
            else:
                self.stop(SAFE, BAD_COMMAND)
        if self.sampling == ON_COMMAND or not self.configured:
            self.sample()

    def pass_period(self):
        if self.silence_left is not None:
            self.silence_left -= 1
            if self.silence_left == 0:
                self.stop(SAFE, HOST_SILENT)
        if self.configured and self.sampling == FREE_RUNNING:
            self.sample()

    def stop(self, state, cause):
        self.state, self.cause = state, cause
        self.stops = (self.stops + 1) & 0xFFFF
        self.torques, self.dampings = [0.0] * self.joints, self.safe_dampings
        self.silence_left = None

    def sample(self):
        rise = self.samples * 3 % 1000
        moved = rise if rise < 500 else 1000 - rise
        counts = [first + moved for first in self.drives.first_counts]
        joints, brakes = self.joints, self.brakes
        self.send(frame(self.drives.sample,
                        struct.pack(f"<Q{joints}Q{joints}i{joints}f{brakes}fIHBB", time.monotonic_ns(), *[0] * joints,
                                    *counts,
                                    *self.torques, *self.dampings, self.commands.newest or 0, self.stops, self.state,
                                    self.cause),
                        self.samples & 0xFFFFFFFF))
        self.samples += 1


def serve(descriptor, drives):
    board = Board(lambda data: os.write(descriptor, data), drives)
    try:
        serve_until_hangup(board, descriptor)
    finally:
        listed = [", ".join(f"{value:g}" for value in values) for values in (board.torques, board.dampings)]
        print(f"left with torque {listed[0]}, damping {listed[1]}", flush=True)


def serve_until_hangup(board, descriptor):
    next_period = time.monotonic_ns() + board.period
    while True:
        left = next_period - time.monotonic_ns()
        if left <= 0:
            board.pass_period()
            next_period += board.period
            continue
        if select.select([descriptor], [], [], left * 1e-9)[0]:
            data = os.read(descriptor, 4096)
            if not data:
                return
            board.take(data)


def main():
    arguments = argparse.ArgumentParser(description="a dashpot board in Python")
    where = arguments.add_mutually_exclusive_group(required=True)
    where.add_argument("--unix", metavar="PATH")
    where.add_argument("--pty", action="store_true")
    arguments.add_argument("--arm", action="store_true")
    chosen = arguments.parse_args()
    drives = Arm if chosen.arm else Handle
    try:
        if chosen.pty:
            near, far = os.openpty()
            tty.setraw(far)
            print(os.ttyname(far), flush=True)
            serve(near, drives)
        else:
            with socket.socket(socket.AF_UNIX) as listening:
                listening.bind(chosen.unix)
                listening.listen(1)
                connection, _ = listening.accept()
                serve(connection.fileno(), drives)
    except OSError as end:
        print(f"peer.py: {end}", file=sys.stderr)


if __name__ == "__main__":
    main()
