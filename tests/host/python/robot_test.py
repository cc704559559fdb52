"""The client of the package against the simulated robot."""

import csv
import math
import os
import pty
import socket
import subprocess
import tempfile
import threading
import tty
import unittest
from dataclasses import replace
from typing import Any
from unittest import mock

try:
    import numpy
    import serial  # noqa: F401
except ImportError as missing:
    raise unittest.SkipTest(f"{missing}: install python3-numpy and python3-serial")

import astrolabe
from astrolabe import messages
from astrolabe.codec import Message
from astrolabe.line import open_line
from astrolabe.messages import ErrorCode, Fault, Mode

import robots


class WithRobot(unittest.TestCase):
    def setUp(self) -> None:
        self.port = self.enterContext(robots.simulated())
        self.robot = self.enterContext(astrolabe.connect(self.port))


class Driving(WithRobot):
    def test_a_square_ends_where_it_began_and_the_robot_is_disarmed(self) -> None:
        with self.robot.record() as recording, self.robot.drive() as drive:
            drive.run(astrolabe.square(0.5))
        end = recording[-1]
        # The robot steers by its odometry: it ends within what its speed loop leaves of a stop, some tenths of a millimetre.
        self.assertLess(math.hypot(end.x_m, end.y_m), 2e-3)
        self.assertAlmostEqual(end.theta_rad, 2 * math.pi, delta=5e-3)
        self.assertEqual(self.robot.status().mode, Mode.disarmed)

    def test_a_velocity_is_held_for_as_long_as_it_is_asked_for(self) -> None:
        with self.robot.record() as recording, self.robot.drive() as drive:
            drive.hold_velocity(0.2, 0, 1.5)
        samples = recording.to_numpy()
        moving = samples[samples["v_mps"] > 0.1]
        self.assertAlmostEqual(float(numpy.median(moving["v_mps"])), 0.2, delta=0.01)  # 5 %: the speed loop's ripple
        # Both ramps pass half the speed, one as long after the start as the other after the end. The robot goes on until the
        # stop arrives, for at most its command time-out of 0.2 s, and two samples are 0.02 s apart.
        self.assertAlmostEqual(float(moving["time_s"][-1] - moving["time_s"][0]), 1.5, delta=0.3)
        self.assertEqual(recording[-1].latched_faults, 0)

    def test_a_velocity_that_nobody_repeats_ends_by_the_robots_time_out(self) -> None:
        with self.assertRaises(astrolabe.DriveFault) as raised, self.robot.drive() as drive:
            drive.set_velocity(0.2, 0)
            drive.wait(5)
        self.assertEqual(raised.exception.fault, Fault.command_timeout)
        with self.robot.drive() as drive:  # which clears what was left behind
            drive.run(astrolabe.spin(0.1))

    def test_an_exception_in_the_block_stops_and_disarms(self) -> None:
        with self.assertRaisesRegex(KeyError, "mine"), self.robot.drive() as drive:
            drive.set_velocity(0.2, 0)
            raise KeyError("mine")
        self.assertEqual(self.robot.status().mode, Mode.disarmed)
        self.assertEqual(self.robot.faults(), [])

    def test_a_ctrl_c_in_the_block_stops_and_disarms(self) -> None:
        with self.assertRaises(KeyboardInterrupt), self.robot.drive() as drive:
            drive.set_velocity(0.2, 0)
            raise KeyboardInterrupt
        self.assertEqual(self.robot.status().mode, Mode.disarmed)

    def _interrupt(self, kind: type[Message], times: int, *, sent: bool) -> None:
        """Ctrl-C at the first requests of this kind: before the robot has them, or before its reply is seen."""
        request = self.robot.client.request
        left = times

        def interrupted(message: Any, *others: Any) -> Any:
            nonlocal left
            now = isinstance(message, kind) and left > 0
            reply = None if now and not sent else request(message, *others)
            if now:
                left -= 1
                raise KeyboardInterrupt
            return reply

        self.enterContext(mock.patch.object(self.robot.client, "request", interrupted))

    def test_a_ctrl_c_before_the_reply_to_arm_disarms(self) -> None:
        self._interrupt(messages.Arm, 1, sent=True)
        with self.assertRaises(KeyboardInterrupt), self.robot.drive():
            self.fail("the block began")
        self.assertEqual(self.robot.status().mode, Mode.disarmed)

    def test_a_ctrl_c_while_the_robot_ramps_down_disarms(self) -> None:
        self._interrupt(messages.Stop, 1, sent=True)
        with self.assertRaises(KeyboardInterrupt), self.robot.drive() as drive:
            drive.set_velocity(0.2, 0)
        self.assertEqual(self.robot.status().mode, Mode.disarmed)

    def test_a_ctrl_c_at_the_disarm_disarms_again(self) -> None:
        self._interrupt(messages.Disarm, 1, sent=False)
        with self.assertRaises(KeyboardInterrupt), self.robot.drive() as drive:
            drive.set_velocity(0.2, 0)
        self.assertEqual(self.robot.status().mode, Mode.disarmed)

    def test_a_ctrl_c_that_keeps_the_robot_armed_is_not_stopped(self) -> None:
        self._interrupt(messages.Disarm, 2, sent=False)
        with self.assertRaisesRegex(astrolabe.NotStopped, "KeyboardInterrupt"), self.robot.drive():
            pass
        self.assertNotEqual(self.robot.status().mode, Mode.disarmed)

    def test_a_robot_with_a_fault_is_not_armed_until_a_person_clears_it(self) -> None:
        self.robot.emergency_stop()
        with self.assertRaises(astrolabe.DriveFault) as raised, self.robot.drive():
            self.fail("it was armed")
        self.assertEqual(raised.exception.fault, Fault.emergency_stop)
        self.assertEqual(self.robot.faults(), [Fault.emergency_stop])
        self.robot.clear_faults()
        with self.robot.drive() as drive:
            drive.run(astrolabe.spin(0.1))

    def test_a_robot_that_is_gone_is_said_to_be_perhaps_moving(self) -> None:
        with self.assertRaisesRegex(astrolabe.NotStopped, "may still be moving"), self.robot.drive():
            self.robot.close()

    def test_a_path_that_is_not_possible_is_refused_before_anything_is_sent(self) -> None:
        for impossible in (lambda: astrolabe.line(math.nan), lambda: astrolabe.line(1e11), lambda: astrolabe.square(-1)):
            with self.assertRaises(astrolabe.InvalidValue):
                impossible()


class Telemetry(WithRobot):
    def test_a_recording_is_the_same_as_array_and_as_table(self) -> None:
        with self.robot.record(period_s=0.01) as recording, self.robot.drive() as drive:
            drive.run(astrolabe.line(0.1))
        array = recording.to_numpy()
        with tempfile.TemporaryDirectory() as folder:
            recording.to_csv(os.path.join(folder, "line.csv"))
            with open(os.path.join(folder, "line.csv"), newline="") as file:
                rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), len(array))
        self.assertEqual([float(row["x_m"]) for row in rows], list(array["x_m"]))
        self.assertEqual([int(row["left_counts"]) for row in rows], list(array["left_counts"]))
        self.assertEqual({row["mode"] for row in rows} - set(Mode.__members__), set())
        numpy.testing.assert_allclose(numpy.diff(array["time_s"]), 0.01, atol=1e-9)

    def test_watching_yields_samples_of_the_robot_at_rest(self) -> None:
        samples = list(self.robot.watch(0.3))
        self.assertGreater(len(samples), 1)
        self.assertEqual({sample.mode for sample in samples}, {Mode.disarmed})

    def test_one_telemetry_at_a_time(self) -> None:
        with self.robot.record(), self.assertRaises(astrolabe.InvalidValue), self.robot.record():
            pass


class Parameters(WithRobot):
    def test_a_new_set_is_in_force_for_everybody_and_kept(self) -> None:
        self.robot.parameters.set({"b": 0.2875, "robot_name": "lisp"})
        self.robot.close()
        with astrolabe.connect(self.port) as again:
            self.assertEqual(again.parameters["b"].value, 0.2875)
            self.assertEqual(again.parameters["robot_name"].value, "lisp")
            self.assertEqual(str(again.parameters["b"]), "b = 0.2875 m")

    def test_values_survive_a_round_trip_through_the_table(self) -> None:
        for row in self.robot.parameters.values():
            self.assertEqual((row.stage(row.value).value, row.stage(row.value).text), (row.held.active, row.held.active_text))

    def test_what_the_table_does_not_allow_is_refused_before_anything_is_sent(self) -> None:
        before = self.robot.parameters["b"].value
        for values in ({"b": 0.28, "c_R": 1e9}, {"b": 0.28, "nonsense": 1}, {"b": "wide"}, {"b": math.inf}, {"robot_name": 3}):
            with self.assertRaises(astrolabe.InvalidValue):
                self.robot.parameters.set(values)
        self.robot.parameters.refresh()
        self.assertEqual(self.robot.parameters["b"].value, before)

    def test_a_set_that_the_robot_refuses_changes_nothing_and_names_the_parameter(self) -> None:
        limit = float(self.robot.parameters["speed_limit"].value)
        with self.assertRaisesRegex(astrolabe.RobotRefused, "over_speed"):
            self.robot.parameters.set({"b": 0.28, "over_speed": limit / 2})
        self.robot.parameters.refresh()
        self.assertEqual(self.robot.parameters["b"].value, 0.29)

    def test_a_value_that_the_robot_refuses_to_stage_leaves_nothing_staged(self) -> None:
        row = self.robot.parameters["c_R"]
        wider = replace(row, info=replace(row.info, maximum=2**31 - 1))  # as a table of another firmware would say
        self.enterContext(mock.patch.dict(self.robot.parameters._rows, {"c_R": wider}))
        assert row.maximum is not None
        with self.assertRaises(astrolabe.RobotRefused):
            self.robot.parameters.set({"b": 0.28, "c_R": 1.2 * row.maximum})
        held = self.robot.client.request(messages.GetParameter(self.robot.parameters["b"].info.id))
        self.assertEqual(held.staged, held.active)

    def _let_velocities_last(self) -> None:
        """A simulator in fast motion may drive for tenths of a second between two requests."""
        self.robot.parameters.set({"command_timeout": 10_000})  # ms

    def test_a_robot_that_drives_keeps_its_set(self) -> None:
        self._let_velocities_last()
        for until_restart in (False, True):
            with self.subTest(until_restart=until_restart), self.robot.drive() as drive:
                drive.set_velocity(0.1, 0)
                with self.assertRaises(astrolabe.RobotRefused) as raised:
                    self.robot.parameters.set({"b": 0.28}, until_restart=until_restart)
            self.assertEqual(raised.exception.code, ErrorCode.moving)
            self.robot.parameters.refresh()
            self.assertEqual(self.robot.parameters["b"].value, 0.29)

    def test_a_robot_that_drives_takes_gains_until_its_restart(self) -> None:
        self._let_velocities_last()
        with self.robot.drive() as drive:
            drive.set_velocity(0.1, 0)
            with self.assertRaises(astrolabe.RobotRefused) as raised:
                self.robot.parameters.set({"kp": 55})
            self.assertEqual(raised.exception.code, ErrorCode.moving)
            self.robot.parameters.set({"kp": 55}, until_restart=True)
        self.robot.parameters.refresh()
        self.assertEqual(self.robot.parameters["kp"].value, 55)

    def test_what_is_set_until_the_restart_is_gone_after_it(self) -> None:
        flash = os.path.join(self.enterContext(tempfile.TemporaryDirectory()), "flash")
        with robots.simulated("--fast", "--flash", flash) as port, astrolabe.connect(port) as robot:
            robot.parameters.set({"b": 0.2875})
            robot.parameters.set({"b": 0.28}, until_restart=True)
            self.assertEqual(robot.parameters["b"].value, 0.28)
        with robots.simulated("--fast", "--flash", flash) as port, astrolabe.connect(port) as robot:
            self.assertEqual(robot.parameters["b"].value, 0.2875)


class Ports(unittest.TestCase):
    def test_a_robot_behind_tcp_is_the_same(self) -> None:
        with robots.simulated() as port, robots.behind_tcp(port) as address, astrolabe.connect(address) as robot:
            with robot.drive() as drive:
                drive.run(astrolabe.spin(0.25))
            self.assertEqual(robot.identity.board, "sim")

    def test_what_is_no_port_is_said_in_one_sentence(self) -> None:
        for address in ("/dev/nonsense", "/dev/null", "/tmp", "tcp:localhost", "tcp:localhost:1", "tcp:192.0.2.1:5555", ""):
            with self.subTest(address), self.assertRaises(astrolabe.PortError) as raised:
                astrolabe.connect(address)
            self.assertNotIn("\n", str(raised.exception))

    def test_a_line_without_a_robot_is_told_from_one_that_echoes(self) -> None:
        path = self._pty()
        with self.assertRaisesRegex(astrolabe.PortError, "does not answer"):
            astrolabe.connect(path)

        def echo(server: socket.socket) -> None:
            caller, _ = server.accept()
            with caller:
                while received := caller.recv(4096):
                    caller.sendall(received)

        server = self.enterContext(socket.create_server(("127.0.0.1", 0)))
        echoing = threading.Thread(target=echo, args=[server])
        echoing.start()
        with self.assertRaisesRegex(astrolabe.PortError, "sends back what it is sent"):
            astrolabe.connect(f"tcp:localhost:{server.getsockname()[1]}")
        echoing.join()  # the line was closed

    def test_a_serial_line_that_nobody_reads_is_lost(self) -> None:
        path = self._pty()
        line = open_line(path)
        with self.assertRaisesRegex(astrolabe.LinkLost, "lost "):
            line.write(bytes(1 << 20))  # more than the kernel holds for a reader
        line.close()

    def test_a_port_whose_holder_is_just_ending_is_opened(self) -> None:
        server = self.enterContext(socket.create_server(("127.0.0.1", 0)))
        port = server.getsockname()[1]
        holder = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        holder.bind(f"\0astrolabe-port-tcp-127.0.0.1-{port}")  # and does not listen, as one that starts or ends
        with mock.patch("astrolabe.line.time.sleep", lambda _: holder.close()):
            open_line(f"tcp:localhost:{port}").close()

    def _pty(self) -> str:
        """The path of a raw pty; nobody reads at its other end."""
        master, slave = pty.openpty()
        self.addCleanup(os.close, master)
        self.addCleanup(os.close, slave)
        tty.setraw(slave)
        return os.ttyname(slave)

    def test_a_port_that_this_package_holds_is_refused_to_a_second_connection(self) -> None:
        with robots.simulated() as port, astrolabe.connect(port):
            with self.assertRaisesRegex(astrolabe.PortError, "in use by another program"):
                astrolabe.connect(port)

    def test_a_stop_from_another_program_ends_the_drive_and_holds(self) -> None:
        port = self.enterContext(robots.simulated("--seed", "1"))
        with astrolabe.connect(port) as alone:  # three programs share the port: a busy machine may hold up this one
            alone.parameters.set({"command_timeout": 10_000})  # ms
        self.enterContext(robots.running([robots.PROGRAM, "monitor", "--port", port, "--json"], until="{"))
        robot = self.enterContext(astrolabe.connect(port))  # through the monitor, which holds the port
        with self.assertRaises(astrolabe.DriveEnded), robot.drive() as drive:
            stop = subprocess.Popen([robots.PROGRAM, "stop", "--port", port], stdout=subprocess.DEVNULL)
            while True:
                drive.run(astrolabe.line(0.1) + astrolabe.line(-0.1))
        self.assertEqual(stop.wait(), 0)
        self.assertEqual(robot.status().mode, Mode.disarmed)


if __name__ == "__main__":
    unittest.main()
