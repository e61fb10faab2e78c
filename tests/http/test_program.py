# SPDX-License-Identifier: GPL-3.0-or-later
"""The program: its settings, where it listens, its log."""
import signal
import socket
import subprocess

from conftest import CHEAP, PATIENCE, PATH, PROGRAM


def run(*flags, environment=None):
    return subprocess.run([PROGRAM, *flags], capture_output=True, text=True, timeout=PATIENCE, env=environment)


def test_check_config_names_every_fault(tmp_path):
    file = tmp_path / "strum.conf"
    file.write_text("cach_bytes = 5\nworkers = some\n")
    bad = run("--config", str(file), "--check-config", "--listn", environment={"STRUM_RETRY_AFTER_S": "-1"})
    assert bad.returncode == 2 and bad.stdout == ""
    lines = bad.stderr.splitlines()
    assert len(lines) == 4
    assert lines[0] == f'{file}:1: unknown setting "cach_bytes"; did you mean cache_bytes?'
    assert lines[1].startswith(f"{file}:2: workers ")
    assert lines[2].startswith("STRUM_RETRY_AFTER_S: ")
    assert lines[3] == 'flags: unknown setting "--listn"; did you mean listen?'
    file.write_text("workers = 2\n")
    good = run("--config", str(file), "--check-config")
    assert (good.returncode, good.stderr) == (0, "")


def test_check_config_opens_what_it_names(tmp_path):
    good_tokens = tmp_path / "tokens"
    good_tokens.write_text("0123456789abcdef\n")
    faults = {
        ("--token-file", str(tmp_path / "none")): "token_file: ", ("--listen", "192.0.2.1:80", "--allow-non-loopback"): "listen: ",
        ("--listen", "nonsense"): "listen must be ", ("--listen", "0.0.0.0:0"): "listen: ",
        ("--listen", "no.such.host.invalid:80"): "listen: ", ("--store", "nonsense"): "store must be ",
        ("--store", "no.such.host.invalid:6379"): "store: ",
        ("--store", "127.0.0.1:6379", "--store-secret-file", str(tmp_path / "none")): "store_secret_file",
        ("--store", "127.0.0.1:6379", "--store-password-file", str(tmp_path / "none")): "store_password_file"}
    for flags, begin in faults.items():
        bad = run("--check-config", "--listen", "127.0.0.1:0", *flags)
        assert (bad.returncode, bad.stdout) == (2, ""), flags
        assert bad.stderr.startswith(begin), (flags, bad.stderr)
    every = run("--check-config", "--listen", "nonsense", "--store", "nonsense", "--token-file", str(tmp_path / "none"))
    assert len(every.stderr.splitlines()) == 3
    good = run("--check-config", "--listen", "0.0.0.0:0", "--token-file", str(good_tokens))
    assert (good.returncode, good.stdout, good.stderr) == (0, "settings are good\n", "")


def test_check_config_while_it_runs(start_strumd, tmp_path):
    """Its own address is taken, and a store may be away: that is no fault."""
    strumd = start_strumd()
    good = run("--check-config", "--listen", strumd.address, "--store", f"unix:{tmp_path}/none")
    assert good.returncode == 0 and good.stderr == ""
    assert good.stdout == f"store: unix:{tmp_path}/none does not answer now; strumd starts and solves without it\nsettings are good\n"


def test_variables_of_a_cluster_are_not_ours():
    """What Kubernetes sets for services named strum, strum-store and strum-cache-bytes."""
    ports = {}
    for name in ("STRUM", "STRUM_STORE", "STRUM_CACHE_BYTES"):
        ports |= {f"{name}_SERVICE_HOST": "10.0.0.1", f"{name}_SERVICE_PORT": "80", f"{name}_SERVICE_PORT_HTTP": "80",
                  f"{name}_PORT": "tcp://10.0.0.1:80", f"{name}_PORT_80_TCP": "tcp://10.0.0.1:80",
                  f"{name}_PORT_80_TCP_PROTO": "tcp", f"{name}_PORT_80_TCP_ADDR": "10.0.0.1"}
    assert run("--print-config", environment=ports).stderr == ""
    assert run("--print-config", environment={"STRUM_STORE_SERVICES": "1"}).returncode == 2
    assert run("--print-config", environment={"STRUM_REPORT": "1"}).returncode == 2


def test_signals_that_mean_nothing_do_not_end_it(start_strumd):
    strumd = start_strumd()
    named = [signal.SIGPIPE, signal.SIGUSR1, signal.SIGUSR2, signal.SIGALRM, signal.SIGVTALRM, signal.SIGPROF, signal.SIGIO,
             signal.SIGPWR, signal.SIGXFSZ, signal.SIGHUP, signal.SIGRTMIN, signal.SIGRTMIN + 1, signal.SIGRTMAX]
    for number in named:
        strumd.process.send_signal(number)
        assert strumd.get("/livez").status_code == 200, number
    assert strumd.end() == 0
    strumd.wait_log("reload")


def test_faults_keep_it_from_starting():
    assert run("--workers", "x").returncode == 2


def test_precedence(tmp_path):
    file = tmp_path / "strum.conf"
    file.write_text("workers = 2\nqueue_depth = 2\nretry_after_s = 2\n")
    environment = {"STRUM_CONFIG": str(file), "STRUM_QUEUE_DEPTH": "3", "STRUM_RETRY_AFTER_S": "3"}
    printed = run("--retry-after-s=4", "--print-config", environment=environment).stdout.splitlines()
    assert {"workers = 2", "queue_depth = 3", "retry_after_s = 4", "listen = 127.0.0.1:8080"} <= set(printed)


def test_print_config_reads_back(tmp_path):
    file = tmp_path / "strum.conf"
    first = run("--print-config", "--cache-bytes", "3M", "--cors-origins", "https://a.example").stdout
    file.write_text(first)
    assert run("--print-config", "--config", str(file)).stdout == first


def test_help_and_version():
    assert "--cache-bytes (64M; " in run("--help").stdout
    assert run("--version").stdout.startswith("strumd 0.")


def test_the_manual_page_has_every_setting():
    page = run("--help-man").stdout
    assert page.startswith(".TH STRUMD 8 ")
    keys = [line.split(" = ")[0] for line in run("--print-config").stdout.splitlines()]
    assert len(keys) > 25
    for key in keys:
        flag = ("--" + key.replace("_", "-")).replace("-", r"\-")
        assert f"\n.TP\n.B {flag}\n(" in page, key
    # What each is for is the same text as in --help.
    helps = [line.strip() for line in run("--help").stdout.split("settings (default; range):\n")[1].splitlines()[1::2]]
    assert len(helps) == len(keys)
    for text in helps:
        assert "\n.br\n" + text.replace("-", r"\-") + "\n" in page


def test_other_machines_are_kept_out_unless_meant(start_strumd):
    for where in ("0.0.0.0:0", "[::]:0"):
        refused = run("--listen", where)
        assert refused.returncode == 1
        assert "allow_non_loopback" in refused.stderr
    strumd = start_strumd("--listen", "0.0.0.0:0", "--allow-non-loopback")
    with socket.create_connection(("127.0.0.1", strumd.port), timeout=PATIENCE) as connection:
        connection.sendall(b"GET /livez HTTP/1.1\r\nHost: localhost\r\n\r\n")
        assert connection.recv(100).startswith(b"HTTP/1.1 200 ")


def test_addresses(start_strumd):
    strumd = start_strumd("--listen", "[::1]:0")
    assert strumd.address == f"[::1]:{strumd.port}"
    assert strumd.get("/livez").status_code == 200
    assert start_strumd("--listen", "localhost:0").get("/livez").status_code == 200
    taken = run("--listen", strumd.address)
    assert taken.returncode == 1 and "Address already in use" in taken.stderr
    for bad in ("", "127.0.0.1", ":8080", "127.0.0.1:", "127.0.0.1:x", "127.0.0.1:123456", "::1:80", "[::1]",
                "no.such.host.invalid:80"):
        refused = run("--listen", bad)
        assert refused.returncode == 1, bad
        assert '"event":"start"' in refused.stderr


def test_the_log(start_strumd):
    strumd = start_strumd("--log-requests", "all")
    strumd.post(CHEAP, headers={"X-Request-Id": "first"})
    strumd.post(CHEAP)
    strumd.get("/nothing%22%0A%C3%BF")
    strumd.end()
    strumd.wait_log("stopped")
    lines = [line for line in strumd.log if line["event"] == "request"]
    assert [line["status"] for line in lines] == [200, 200, 404]
    assert lines[0]["id"] == "first" and lines[0]["path"] == PATH and lines[0]["bytes"] > 0
    assert lines[1]["id"]
    assert all(line["time"].endswith("Z") and line["level"] == "info" for line in lines)
    for line in strumd.log:
        assert "sag_parameter" not in str(line)


def test_what_is_logged_is_chosen(start_strumd):
    for level, expected in (("none", []), ("errors", []), ("refusals", [404])):
        strumd = start_strumd("--log-requests", level)
        strumd.post(CHEAP)
        strumd.get("/nothing")
        strumd.end()
        strumd.wait_log("stopped")
        assert [line["status"] for line in strumd.log if line["event"] == "request"] == expected
