# SPDX-License-Identifier: GPL-3.0-or-later
"""What a service manager is told (sd_notify), and that it is told nothing when an event thread hangs."""
import ctypes
import os
import pathlib
import signal
import socket

import pytest

from conftest import CHEAP, PATIENCE

PTRACE_SEIZE, PTRACE_INTERRUPT, PTRACE_DETACH = 0x4206, 0x4207, 17
LIBC = ctypes.CDLL(None, use_errno=True)
LIBC.ptrace.argtypes = [ctypes.c_long, ctypes.c_long, ctypes.c_void_p, ctypes.c_void_p]


def ptrace(what, thread):
    assert LIBC.ptrace(what, thread, None, None) == 0, os.strerror(ctypes.get_errno())


@pytest.fixture
def manager(tmp_path):
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as listener:
        listener.bind(str(tmp_path / "notify"))
        listener.settimeout(PATIENCE)
        yield listener


def told(manager):
    return manager.recv(1000).decode()


def test_without_a_watchdog_it_says_when_it_is_ready_and_when_it_stops(start_strumd, manager):
    strumd = start_strumd(environment={"NOTIFY_SOCKET": manager.getsockname()})
    assert told(manager) == "READY=1"
    assert strumd.get("/livez").status_code == 200
    strumd.end()
    assert told(manager) == "STOPPING=1"


@pytest.mark.parametrize("threads", [1, 3])
def test_the_watchdog_is_fed_while_all_event_threads_answer(start_strumd, manager, threads):
    strumd = start_strumd("--event-threads", str(threads),
                          environment={"NOTIFY_SOCKET": manager.getsockname(), "WATCHDOG_USEC": "600000"})
    assert [told(manager) for _ in range(4)] == ["READY=1"] + 3 * ["WATCHDOG=1"]
    tasks = pathlib.Path(f"/proc/{strumd.process.pid}/task")
    # libmicrohttpd names its threads: MHD-single, or MHD-listen (idle here) and MHD-worker
    events = [int(task.name) for task in tasks.iterdir() if (task / "comm").read_text().strip() in ("MHD-single", "MHD-worker")]
    assert len(events) == threads
    for thread in events:
        ptrace(PTRACE_SEIZE, thread)
        ptrace(PTRACE_INTERRUPT, thread)
        os.waitpid(thread, 0x40000000)  # __WALL
        manager.settimeout(1)  # a beat that was asked before may still come
        try:
            while told(manager):
                pass
        except TimeoutError:
            pass
        manager.settimeout(2)
        with pytest.raises(TimeoutError):
            told(manager)
        manager.settimeout(PATIENCE)
        ptrace(PTRACE_DETACH, thread)
        assert told(manager) == "WATCHDOG=1"
    assert strumd.post(CHEAP).status_code == 200
    strumd.end(signal.SIGTERM)


def test_another_process_watchdog_is_not_fed(start_strumd, manager):
    start_strumd(environment={"NOTIFY_SOCKET": manager.getsockname(), "WATCHDOG_USEC": "30000", "WATCHDOG_PID": "1"})
    assert told(manager) == "READY=1"
    manager.settimeout(0.5)
    with pytest.raises(TimeoutError):
        told(manager)
