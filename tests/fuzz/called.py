"""Calls the program for the tests of this folder and checks what no call may do."""

import os
import signal
import subprocess
import threading
import time

INTERRUPTED_AFTER, KILLED_AFTER = 8, 20  # seconds; a run that is only long ends when it is interrupted
RESIDENT_BYTES = 1_000_000_000
LINE_BYTES = 1_000


def cases(default):
    return max(int(os.environ.get("DUSTBENCH_FUZZ_CASES", default)), 1)


def seed():
    return int(os.environ.get("DUSTBENCH_FUZZ_SEED", 20_260_728))


class Call:
    """One call, without a display and a terminal. `faults`: violations of what every call must respect."""

    def __init__(self, program, arguments, folder):
        environment = {name: value for name, value in os.environ.items()
                       if name not in ("DISPLAY", "WAYLAND_DISPLAY", "DUSTBENCH_DATA", "DUSTBENCH_ADAPTER")}
        self.arguments = arguments
        begin = time.monotonic()
        with open(os.path.join(folder, ".stdout"), "wb+") as out, open(os.path.join(folder, ".stderr"), "wb+") as err:
            process = subprocess.Popen([program, *arguments], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                                       stdout=out, stderr=err, start_new_session=True)
            interrupt = threading.Timer(INTERRUPTED_AFTER, os.kill, (process.pid, signal.SIGINT))
            kill = threading.Timer(KILLED_AFTER, os.killpg, (process.pid, signal.SIGKILL))
            for timer in (interrupt, kill):
                timer.start()
            _, status, usage = os.wait4(process.pid, 0)
            for timer in (interrupt, kill):
                timer.cancel()
            self.code = process.returncode = os.waitstatus_to_exitcode(status)
            out.seek(0)
            err.seek(0)
            self.out, self.err = out.read(), err.read()
        self.seconds = time.monotonic() - begin
        self.resident_bytes = usage.ru_maxrss * 1024
        self.faults = list(self._faults())

    def _faults(self):
        if self.code < 0 or self.seconds >= KILLED_AFTER:
            yield f"ended by signal {-self.code} after {self.seconds:.1f} s"
        elif self.code > 6 or self.code == 4:
            yield f"exit code {self.code}"
        if self.resident_bytes > RESIDENT_BYTES:
            yield f"{self.resident_bytes / 1e6:.0f} MB resident"
        said = [line for line in self.err.split(b"\n") if line.startswith(b"dustbench: ")]
        if len(said) != 1 if self.code == 3 else len(said) > 1:
            yield f"{len(said)} lines of its own with exit code {self.code}"
        if any(len(line) > LINE_BYTES for line in said):
            yield f"a line of {max(map(len, said))} bytes"
        if any(byte < 0x20 and byte != 0x0A or byte == 0x7F for byte in self.err):
            yield "control bytes on stderr"

    def __str__(self):
        shown = [argument if len(argument) < 100 else argument[:40] + b"[...]" + argument[-40:]
                 for argument in map(os.fsencode, self.arguments)]
        return f"{shown!r}\n  {'; '.join(self.faults)}\n  {self.err[-600:]!r}"
