"""What is run against a change: small test programs, each linked from as little as it needs."""
from pathlib import Path

# From the fewest to compile to the most; `order_for` says which a change has to pass.
PROGRAMS = ["safety", "params", "kinematics", "control", "tick", "robot"]
ORDER = {
    "common/safety": ["safety", "tick", "robot"],
    "common/params": ["params", "tick", "robot"],
    "common/kinematics": ["kinematics", "control", "tick", "robot"],
    "common/control": ["control", "tick", "robot"],
    "firmware/app": ["tick", "robot"],
}
# They cut the power after every byte or wear out sectors, which takes minutes without optimisation.
TOO_LONG = {"fault_log_faults_test.cpp", "power_cut_test.cpp", "thousand_commits_test.cpp", "wear_test.cpp"}
SCENARIOS = ["fault_matrix_test.cpp", "stopping_test.cpp", "lives_test.cpp"]
# The simulated robot with a client in process: what its tests link of the host's tools.
HOST = ["base/text/numbers.cpp", "base/system_error.cpp", "base/text/plain_text.cpp", "robot/client/client.cpp",
        "robot/client/clock_map.cpp", "robot/client/handshake.cpp", "robot/client/refusal.cpp", "robot/motion/drive.cpp",
        "robot/motion/other_program.cpp", "robot/motion/paths.cpp", "robot/motion/rest.cpp",
        "robot/parameters/parameter_row.cpp", "robot/parameters/parameters.cpp", "robot/port/ports.cpp",
        "robot/sharing/port_socket.cpp", "simulation/robot/in_process.cpp", "simulation/robot/virtual_mocap.cpp",
        "simulation/robot/virtual_robot.cpp"]
PRECOMPILED = ["gmock/gmock.h", "gtest/gtest.h", "algorithm", "array", "chrono", "cmath", "filesystem", "functional",
               "map", "memory", "random", "span", "string", "vector"]
# -O1: -O0 runs the simulated robot ten times slower, -O2 compiles half as fast again.
FLAGS = "-std=c++20 -I. -isystem /usr/include/eigen3 -g0 -w -D_GLIBCXX_ASSERTIONS"


def order_for(file):
    for folder in Path(file).parents:  # rooms of firmware/app have no line of their own
        if str(folder) in ORDER:
            return ORDER[str(folder)]
    return PROGRAMS


def needs_the_simulator(source):
    return any(word in source.read_text() for word in ("bench_robot.hpp", "drive_rig.hpp", "desk.hpp", "host/"))


def sources(folder):
    """The tests of each program, and what is linked to them."""
    def in_folder(name):
        return sorted(p for p in (folder / name).glob("*.cpp") if p.name not in TOO_LONG)

    firmware = [p for room in ("hosts", "tick") for p in in_folder(f"tests/firmware/{room}")]
    seed = [folder / "tests/common/protocol/fixed_seed.cpp"]
    tests = {
        "safety": in_folder("tests/common/safety"),
        "params": in_folder("tests/common/params"),
        "kinematics": in_folder("tests/common/kinematics"),
        "control": in_folder("tests/common/control") + seed,
        "tick": [p for p in firmware if not needs_the_simulator(p)],
        "robot": [p for p in firmware if needs_the_simulator(p)] +
                 [folder / "tests/scenario" / name for name in SCENARIOS],
    }
    core = sorted((folder / "common").glob("*/*.cpp")) + sorted((folder / "hal/sim").glob("*.cpp"))
    firmware_sources = sorted((folder / "firmware/app").glob("**/*.cpp"))
    host = [folder / "host" / name for name in HOST]
    linked = {name: list(core) for name in PROGRAMS}
    linked["tick"] += firmware_sources
    linked["robot"] += firmware_sources + host + [folder / "tests/support/robots/robot_life.cpp"]
    return tests, linked


def write_ninja(folder):
    (folder / "precompiled.hpp").write_text("".join(f"#include <{header}>\n" for header in PRECOMPILED))
    tests, linked = sources(folder)
    object_of = lambda path: f"o/{path.relative_to(folder)}.o"
    text = [f"flags = {FLAGS}",
            "rule precompile\n  command = g++ $flags -O0 -x c++-header $in -o $out",
            "rule test\n  command = g++ $flags -O0 -include precompiled.hpp -MMD -MF $out.d -c $in -o $out\n"
            "  depfile = $out.d\n  deps = gcc",
            "rule source\n  command = g++ $flags -O1 -MMD -MF $out.d -c $in -o $out\n  depfile = $out.d\n  deps = gcc",
            "rule link\n  command = g++ -fuse-ld=gold $in -o $out -lgmock -lgtest -lgtest_main -lrapidcheck -lfmt"
            " -lpthread",
            "build precompiled.hpp.gch: precompile precompiled.hpp"]
    for path in sorted({p for paths in tests.values() for p in paths}):
        text.append(f"build {object_of(path)}: test {path.relative_to(folder)} | precompiled.hpp.gch")
    for path in sorted({p for paths in linked.values() for p in paths}):
        text.append(f"build {object_of(path)}: source {path.relative_to(folder)}")
    for name in PROGRAMS:
        text.append(f"build {name}: link {' '.join(object_of(p) for p in tests[name] + linked[name])}")
    ninja = folder / "build.ninja"
    new = "\n".join(text) + "\n"
    if not ninja.exists() or ninja.read_text() != new:
        ninja.write_text(new)
