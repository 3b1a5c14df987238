"""The server of a sweep's page: it drives what its page asks for, shows what `slalom` left there, and nobody else's
requests or slowness get anything out of it."""

import concurrent.futures
import os
import re
import shutil
import signal
import socket
import time
import unittest
import urllib.error
import urllib.request

from program import interrupt, run, start
from sweeps import SMALL, SweepTest


class Served(SweepTest):
    def setUp(self):
        super().setUp()
        self.sweep("out", "--limit", "2")
        self.out = self.folder / "out"
        self.process = start("study-report", self.out, "--serve", "0")
        self.addCleanup(self.end)
        address = ""
        while not address.startswith("http"):
            address = self.process.stdout.readline().split(" ")[0]
        self.address = address
        self.base = address.rsplit("/", 1)[0]
        self.port, self.token = re.fullmatch(r"http://localhost:(\d+)/([0-9a-f]{32})", self.base).groups()

    def end(self):
        if self.process.poll() is None:
            interrupt(self.process)

    def ask(self, path, *headers, method="GET", host=None, seconds=30):
        """Status and content of an answer to a request of one's own words."""
        head = [f"{method} {path} HTTP/1.1", f"Host: {host or 'localhost:' + self.port}", *headers]
        with self.connection(seconds) as client:
            client.sendall(("\r\n".join(head) + "\r\n\r\n").encode())
            return self.answer(client)

    def connection(self, seconds=30):
        client = socket.create_connection(("127.0.0.1", int(self.port)))
        client.settimeout(seconds)
        return client

    @staticmethod
    def answer(client):
        got = b""
        while part := client.recv(1 << 20):
            got += part
        head, _, content = got.partition(b"\r\n\r\n")
        return int(head.split(b" ")[1]), content

    def page(self, name):
        return f"/{self.token}/{name}"

    def memory(self):
        """The most memory the server has had [MB]."""
        with open(f"/proc/{self.process.pid}/status") as file:
            return int(re.search(r"VmHWM:\s+(\d+)", file.read()).group(1)) / 1024

    def test_it_drives_what_is_asked_for(self):
        self.assertIn(b"Click on a trial", urllib.request.urlopen(self.address, timeout=20).read())
        self.assertFalse((self.out / "drives").exists())
        drive = urllib.request.urlopen(f"{self.base}/drives/000001/report.html", timeout=60).read()
        self.assertEqual(drive, (self.out / "drives/000001/report.html").read_bytes())
        figures = [f"figures/{figure.name}" for figure in (self.out / "figures").iterdir()]
        for name in ("trials.csv", "drives/000001/plant.csv", *figures):
            self.assertEqual(urllib.request.urlopen(f"{self.base}/{name}", timeout=20).read(),
                             (self.out / name).read_bytes())
        for number, said in (("000003", b"has not run yet"), ("000099", b"from 1 to 12")):
            with self.assertRaises(urllib.error.HTTPError) as refused:
                urllib.request.urlopen(f"{self.base}/drives/{number}/report.html", timeout=20)
            self.assertEqual(refused.exception.code, 404)
            self.assertIn(said, refused.exception.read())
            refused.exception.close()
        taken = run("study-report", self.out, "--serve", self.port)
        self.assertEqual(taken.code, 3)
        self.assertIn("is taken", taken.err)
        interrupt(self.process)
        self.assertEqual(self.process.returncode, 0)

    def test_a_drive_that_is_not_as_recorded_is_not_shown_without_a_word(self):
        page = self.page("drives/000001/report.html")
        drive = self.ask(page)[1]
        self.assertIn(b"<html", drive)
        summary = self.out / "drives/000001/summary.json"
        summary.write_text(summary.read_text().replace('"time_s": ', '"time_s": 1'))
        status, said = self.ask(page)
        self.assertEqual(status, 200)
        self.assertIn(b"the one that the sweep recorded: time_s 1", said)
        self.assertIn(b'href="report.html?anyway"', said)
        self.assertEqual(self.ask(page + "?anyway"), (200, drive))
        self.assertEqual(self.ask(self.page("drives/000001/summary.json"))[1], summary.read_bytes())

    def test_requests_of_others_are_refused(self):
        drive = self.page("drives/000001/report.html")
        for host in ("evil.example", f"evil.example:{self.port}", "localhost:1", f"localhost:{self.port}.evil.example",
                     f"localhost:{self.port}\r\nHost: evil.example", "127.0.0.1.evil.example", "0x7f.1"):
            with self.subTest(host):
                self.assertEqual(self.ask(self.page("trials.csv"), host=host)[0], 403)
        for header in ("Origin: http://evil.example", "Origin: null", f"Origin: https://localhost:{self.port}",
                       "Origin: http://localhost:1", "Sec-Fetch-Site: cross-site", "Sec-Fetch-Site: same-site"):
            with self.subTest(header):
                self.assertEqual(self.ask(drive, header)[0], 403)
        for path in ("/", "/index.html", "/trials.csv", "/drives/000001/report.html", f"/{self.token[:-1]}0/trials.csv",
                     f"/{self.token}", "http://localhost/trials.csv", f"/{self.token.upper()}x/trials.csv"):
            with self.subTest(path):
                self.assertEqual(self.ask(path)[0], 403)
        for method in ("POST", "PUT", "DELETE", "OPTIONS", "TRACE", "get", "CONNECT"):
            with self.subTest(method):
                self.assertEqual(self.ask(drive, method=method)[0], 405)
        self.assertEqual(self.ask(drive, method="HEAD"), (404, b""))
        self.assertEqual(self.ask(drive, "Sec-Purpose: prefetch;prerender")[0], 404)
        self.assertEqual(self.ask(drive, "Purpose: prefetch")[0], 404)
        time.sleep(0.5)
        self.assertFalse((self.out / "drives").exists())
        own = (f"Origin: http://localhost:{self.port}", "Sec-Fetch-Site: same-origin")
        self.assertEqual(self.ask(drive, *own)[0], 200)
        self.assertEqual(self.ask(drive, method="HEAD"), (200, b""))

    def test_nothing_but_known_names_is_shown(self):
        secret = self.folder / "secret.html"
        secret.write_text("secret")
        (self.out / ".hidden.svg").write_text("secret")
        (self.out / "notes.html").write_text("secret")
        (self.out / "figures/.x.svg").write_text("secret")
        os.symlink(secret, self.out / "figures/out.svg")
        os.symlink(self.folder, self.out / "drives")
        (self.folder / "000001").mkdir()
        shutil.copy(secret, self.folder / "000001/report.html")
        (self.out / "trials.csv").unlink()
        os.mkfifo(self.out / "trials.csv")
        for name in ("", "secret.html", "../secret.html", "%2e%2e/secret.html", "figures/../notes.html", "notes.html",
                     ".hidden.svg", "figures/.x.svg", "figures/out.svg", "figures", "figures/", "trials.sqlite",
                     ".trials.lock", "trials.csv", "drives/000001/plant.csv", "drives/000001/../report.html",
                     "drives/0/report.html", "drives/-1/report.html", "drives/9999999999/report.html", "index.html/",
                     "/index.html", "index%00.html", "drives/000001/figures/../report.html"):
            with self.subTest(name):
                status, content = self.ask(self.page(name))
                self.assertEqual(status, 404)
                self.assertNotIn(b"secret", content)

    def test_malformed_requests_and_content_are_refused(self):
        good = f"Host: localhost:{self.port}\r\n"
        for head in ("GET\r\n", "GET /\r\n", f"GET  / HTTP/1.1\r\n{good}", f"GET / HTTP/2.0\r\n{good}",
                     f"GET / HTTP/1.1\r\n{good}: x\r\n", f"GET / HTTP/1.1\r\n{good} folded\r\n",
                     f"GET / HTTP/1.1\r\nHost : localhost\r\n", f"GET /\x01 HTTP/1.1\r\n{good}",
                     f"GET / HTTP/1.1\r\n{good}X: a\x00b\r\n", "\x16\x03\x01\r\n", "\r\n"):
            with self.subTest(head), self.connection() as client:
                client.sendall((head + "\r\n").encode("latin-1"))
                self.assertEqual(self.answer(client)[0], 400)
        with self.connection() as client:
            client.sendall(f"GET / HTTP/1.1\r\n{good}X: {'a' * 9000}\r\n\r\n".encode())
            self.assertEqual(self.answer(client)[0], 431)
        index = self.page("index.html")
        for header in ("Content-Length: 5", "Transfer-Encoding: chunked", "Content-Length: -1",
                       "Content-Length: 0\r\nContent-Length: 7"):
            with self.subTest(header):
                self.assertEqual(self.ask(index, header)[0], 413)
        self.assertEqual(self.ask(index, "Content-Length: 0")[0], 200)

    def test_neither_content_nor_ranges_cost_memory(self):
        before = self.memory()
        with self.connection() as client:
            client.sendall(f"POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 3000000000\r\n\r\n".encode())
            taken = 0
            try:
                while taken < 100:
                    client.sendall(b"a" * (1 << 20))
                    taken += 1
            except OSError:
                pass
        self.assertLess(taken, 20)
        with open(self.out / "trials.csv", "w") as file:
            file.write("x" * 100_000_000)
        status, content = self.ask(self.page("trials.csv"), "Range: bytes=" + ",".join(["0-"] * 1000))
        self.assertEqual((status, len(content)), (200, 100_000_000))
        self.assertLess(self.memory() - before, 50)  # neither what was sent nor what was asked for, even once

    def test_slow_clients_keep_nobody_out(self):
        slow = [self.connection() for _ in range(70)]
        for client in slow:
            client.sendall(b"GET ")
        self.assertEqual(self.ask(self.page("index.html"), seconds=20)[0], 200)
        begin = time.monotonic()
        while slow and time.monotonic() - begin < 60:
            for client in list(slow):
                try:
                    client.sendall(b"x")
                except OSError:
                    client.close()
                    slow.remove(client)
            time.sleep(0.3)
            self.assertEqual(self.ask(self.page("index.html"), seconds=20)[0], 200)
        self.assertEqual(slow, [])

    def test_ctrl_c_ends_it_whoever_is_connected(self):
        with open(self.out / "trials.csv", "w") as file:
            file.write("x" * 20_000_000)
        clients = [self.connection() for _ in range(40)]
        for i, client in enumerate(clients):
            end = "\r\n\r\n" if i % 2 else ""  # half of them never take what they asked for
            client.sendall(f"GET {self.page('trials.csv')} HTTP/1.1\r\nHost: localhost{end}".encode())
        time.sleep(0.5)
        result = interrupt(self.process)
        self.assertEqual(result.code, 0)
        self.assertLess(result.seconds, 20)
        for client in clients:
            client.close()


class LongDrive(SweepTest):
    def test_a_drive_that_crashes_costs_its_own_process(self):
        study = self.write("slow.yaml", SMALL.replace("E_B", "E_C").replace("1.5}", "40, planner.N: 200}"))
        self.record_as_failed(study)
        process = start("study-report", self.folder / "out", "--serve", "0")
        self.addCleanup(interrupt, process)
        while not (address := process.stdout.readline().split(" ")[0]).startswith("http"):
            pass
        with concurrent.futures.ThreadPoolExecutor() as pool:
            page = pool.submit(urllib.request.urlopen, address.replace("index.html", "drives/000001/report.html"),
                               timeout=60)
            os.kill(self.child_of(process.pid), signal.SIGABRT)
            with self.assertRaises(urllib.error.HTTPError) as refused:
                page.result()
            self.assertEqual(refused.exception.code, 500)
            self.assertIn(b"trial 1: 1 attempt: the worker was killed by signal 6", refused.exception.read())
            refused.exception.close()
        self.assertIn(b"Click on a trial", urllib.request.urlopen(address, timeout=20).read())

    def record_as_failed(self, study):
        """Strikes every attempt at trial 1."""
        process = start("sweep", study, "--out", self.folder / "out", "--json", "--limit", "1", "--jobs", "1")
        for line in process.stdout:
            if '"started"' in line:
                os.kill(int(re.search(r'"process":(\d+)', line).group(1)), signal.SIGABRT)
        process.communicate(timeout=60)

    @staticmethod
    def child_of(process):
        for _ in range(100):
            for task in os.listdir(f"/proc/{process}/task"):
                with open(f"/proc/{process}/task/{task}/children") as file:
                    if children := file.read().split():
                        time.sleep(0.5)
                        return int(children[0])
            time.sleep(0.05)
        raise AssertionError("no process drives")

    def test_ctrl_c_ends_a_drive_at_work_and_leaves_nothing_of_it(self):
        study = self.write("slow.yaml", SMALL.replace("E_B", "E_C").replace("1.5}", "40, planner.N: 200}"))
        self.sweep("out", "--limit", "0", study=study)
        # Recorded as failed without being driven: a store of its own making would take as long.
        self.record_as_failed(study)
        for arguments in (["--trial", "1"], ["--serve", "0"]):
            process = start("study-report", self.folder / "out", *arguments)
            if arguments[0] == "--serve":
                while not (address := process.stdout.readline().split(" ")[0]).startswith("http"):
                    pass
                host = address.split("/")[2]
                client = socket.create_connection(("127.0.0.1", int(host.split(":")[1])))
                path = "/" + address.split("/")[3] + "/drives/000001/report.html"
                client.sendall(f"GET {path} HTTP/1.1\r\nHost: {host}\r\n\r\n".encode())
                self.addCleanup(client.close)
            time.sleep(1)
            self.assertIsNone(process.poll())
            result = interrupt(process)
            self.assertLess(result.seconds, 20)
            self.assertEqual(result.code, 130 if arguments[0] == "--trial" else 0, result.err)
            self.assertFalse((self.folder / "out/drives/000001/report.html").exists())


if __name__ == "__main__":
    unittest.main()
