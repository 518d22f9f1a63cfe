#!/usr/bin/env python3
"""A board in Python, written from runtime/devices/board/README.md alone: the second implementation of the protocol.

    peer.py --unix PATH     listens on a Unix socket and serves one host
    peer.py --pty           opens a pseudo-terminal, prints the path of its far end, and serves that

Its handle moves by itself: 3 counts a sample upwards until 500, then down again, and so on. In the end it prints what the
host has left it with.
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
LENGTH = {HELLO: 0, DESCRIPTION: 41, CONFIGURE: 16, CONFIGURED: 3, RESET: 2, COMMAND: 8, SAMPLE: 36,
          ASK_STATISTICS: 0, STATISTICS: 44}
IDLE, RUNNING, SAFE = 0, 1, 2
HOST_SILENT, BAD_COMMAND, COMMANDS_ANEW = 1, 2, 6
ON_COMMAND, FREE_RUNNING = 0, 1
HOST, OWN_MODEL = 0, 1
ACCEPTED, PERIOD_TOO_SHORT, WATCHDOG_NEEDED, DAMPING_OUT_OF_RANGE, NO_MODEL, NO_SUCH_CHOICE, SPEED_LIMIT_WRONG = 0, 1, 2, 3, 4, 6, 7

ENCODER_STEP = 1e-5  # [m]
MAX_TORQUE = 50.0  # [N]
MAX_DAMPING = 30.0  # [N s/m]
POWER_ON_DAMPING = 5.0  # [N s/m]
SHORTEST_PERIOD = 500_000  # [ns]


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
        """Bytes of the frame that begins here, as far as can be told; None where none does."""
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
    def __init__(self, send):
        self.send = send
        self.decoder = Decoder()
        self.commands = Sequence()
        self.state, self.cause, self.stops = IDLE, 0, 0
        self.configured = False
        self.safe_damping = POWER_ON_DAMPING
        self.torque, self.damping = 0.0, self.safe_damping
        self.period, self.watchdog_periods, self.sampling = 1_000_000, 0, ON_COMMAND
        self.silence_left = None  # periods until the watchdog bites; None: it waits for nothing
        self.samples = 0

    def take(self, data):
        for kind, sequence, payload in self.decoder.feed(data):
            if kind == HELLO:
                self.send(frame(DESCRIPTION, struct.pack("<dffIIB16s", ENCODER_STEP, MAX_TORQUE, MAX_DAMPING,
                                                         SHORTEST_PERIOD, 0, 0, b"peer.py")))
            elif kind == CONFIGURE:
                self.configure(*struct.unpack("<IffHBB", payload))
            elif kind == RESET:
                self.reset(*struct.unpack("<H", payload))
            elif kind == COMMAND:
                self.command(sequence, *struct.unpack("<ff", payload))
            elif kind == ASK_STATISTICS:
                heard, obeyed = self.decoder, self.commands
                self.send(frame(STATISTICS, struct.pack("<11I", heard.received, heard.corrupted, heard.discarded,
                                                        heard.foreign, obeyed.lost, obeyed.repeated, obeyed.late,
                                                        0, 0, 0, 0)))

    def configure(self, period, safe_damping, speed_limit, watchdog_periods, sampling, controller):
        self.stop(IDLE, 0)
        if (sampling, controller) not in ((ON_COMMAND, HOST), (FREE_RUNNING, HOST), (FREE_RUNNING, OWN_MODEL)):
            verdict = NO_SUCH_CHOICE
        elif period < SHORTEST_PERIOD:
            verdict = PERIOD_TOO_SHORT
        elif not 0 <= safe_damping <= MAX_DAMPING:
            verdict = DAMPING_OUT_OF_RANGE
        elif not (speed_limit >= 0 and math.isfinite(speed_limit)):
            verdict = SPEED_LIMIT_WRONG
        elif controller == OWN_MODEL:
            verdict = NO_MODEL
        else:
            verdict = ACCEPTED if watchdog_periods else WATCHDOG_NEEDED
        self.configured = verdict == ACCEPTED
        if self.configured:
            self.period, self.watchdog_periods, self.sampling = period, watchdog_periods, sampling
            self.safe_damping = self.damping = safe_damping
            self.commands.restart()
        self.send(frame(CONFIGURED, struct.pack("<BH", verdict, self.stops)))

    def reset(self, stops):
        if self.configured and self.state != RUNNING and stops == self.stops:
            self.state = RUNNING
            self.silence_left = None
        self.sample()

    def command(self, sequence, torque, damping):
        came = self.commands.note(sequence)
        if came == Sequence.OLD:
            return
        if self.state == RUNNING and came == Sequence.ANEW:
            self.stop(SAFE, COMMANDS_ANEW)
        elif self.state == RUNNING:
            self.silence_left = self.watchdog_periods
            if math.isfinite(torque) and math.isfinite(damping):
                self.torque = min(max(torque, -MAX_TORQUE), MAX_TORQUE)
                self.damping = min(max(damping, 0.0), MAX_DAMPING)
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
        self.torque, self.damping = 0.0, self.safe_damping
        self.silence_left = None

    def sample(self):
        rise = self.samples * 3 % 1000
        counts = rise if rise < 500 else 1000 - rise
        self.send(frame(SAMPLE, struct.pack("<QQiffIHBB", time.monotonic_ns(), 0, counts, self.torque, self.damping,
                                            self.commands.newest or 0, self.stops, self.state, self.cause),
                        self.samples & 0xFFFFFFFF))
        self.samples += 1


def serve(descriptor):
    board = Board(lambda data: os.write(descriptor, data))
    try:
        serve_until_hangup(board, descriptor)
    finally:
        print(f"left with torque {board.torque:g}, damping {board.damping:g}", flush=True)


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
    chosen = arguments.parse_args()
    try:
        if chosen.pty:
            near, far = os.openpty()
            tty.setraw(far)
            print(os.ttyname(far), flush=True)
            serve(near)
        else:
            with socket.socket(socket.AF_UNIX) as listening:
                listening.bind(chosen.unix)
                listening.listen(1)
                connection, _ = listening.accept()
                serve(connection.fileno())
    except OSError as end:
        print(f"peer.py: {end}", file=sys.stderr)


if __name__ == "__main__":
    main()
