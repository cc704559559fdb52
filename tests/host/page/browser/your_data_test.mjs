// The page Your data, as somebody uses it who has files and only the page; what it finds is what the command line finds.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { cpSync, existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, truncateSync, writeFileSync } from "node:fs";
import os from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { astrolabe, native_answers, shared_data } from "../module/places.mjs";
import { in_browser } from "./browser.mjs";
import { drive_files } from "./drive_files.mjs";

const folder = mkdtempSync(path.join(os.tmpdir(), "page-data-"));
after(() => rmSync(folder, { recursive: true }));

function run(program, ...words) {
  const ran = spawnSync(program, words, { encoding: "utf8", maxBuffer: 1 << 28, cwd: folder });
  assert.ok(ran.status === 0 || ran.status === 3, `${words.join(" ")}: ${ran.error ?? ran.stderr}`);
  return ran.stdout;
}

/** Squares of a simulated robot as tables and as a bag of others: run-1-wheels.csv, run-1-truth.csv, run-1.db3, ... */
const simulated = [];
before(() => {
  const question = JSON.stringify({ call: "try_out", question: { seed: 3, runs: 2 } });
  const ran = spawnSync(native_answers, [folder], { input: question, encoding: "utf8", maxBuffer: 1 << 28 });
  assert.equal(ran.status, 0, `${native_answers}: ${ran.error ?? ran.stderr}`);
  const recordings = readdirSync(path.join(folder, ".made/try/before")).filter((name) => /square.*\.mcap$/.test(name)).sort();
  recordings.forEach((name, i) => {
    const recording = path.join(folder, ".made/try/before", name);
    run(astrolabe, "export", recording, "--csv", `csv-${i}`, "--rosbag", `bag-${i}`);
    const run_name = `run-${i + 1}`;
    cpSync(path.join(folder, `csv-${i}/odometry.csv`), path.join(folder, `${run_name}-wheels.csv`));
    cpSync(path.join(folder, `csv-${i}/truth.csv`), path.join(folder, `${run_name}-truth.csv`));
    const bag = readdirSync(path.join(folder, `bag-${i}`)).find((each) => each.endsWith(".db3"));
    cpSync(path.join(folder, `bag-${i}`, bag), path.join(folder, `${run_name}.db3`));
    simulated.push(run_name);
  });
  assert.equal(simulated.length, 4);
});

const in_folder = (name) => path.join(folder, name);

/** What the page takes from a person who is asked for sizes in millimetres. */
async function enter_sizes(page, { diameter_mm, counts, wheelbase_mm }) {
  if (diameter_mm !== undefined) await page.getByLabel("Wheel diameter").fill(String(diameter_mm));
  if (wheelbase_mm !== undefined) await page.getByLabel("Wheelbase, mm").fill(String(wheelbase_mm));
  if (counts !== undefined) await page.getByLabel("Counts per turn").fill(String(counts));
}

async function drop(page, files) {
  await page.getByLabel("Drop files").setInputFiles(files);
  await page.getByRole("heading", { name: "What is in them" }).waitFor({ timeout: 60_000 });
  await looked(page, files.length);
}

/** Until the page has looked at this many files as they are now stated. */
async function looked(page, count) {
  await page.locator("tr.file").nth(count - 1).waitFor({ timeout: 60_000 });
  await page.locator("[role=status][aria-busy=false]").nth(0).waitFor({ state: "attached", timeout: 60_000 });
  await page.waitForFunction(() => ![...document.querySelectorAll("[role=status]")].some((each) => each.textContent !== ""), null, { timeout: 60_000 });
}

async function calibrated(page) {
  await page.getByRole("button", { name: "Calibrate", exact: true }).click();
  const result = page.getByRole("region", { name: "Result" }).filter({ visible: true });
  await Promise.race([result.waitFor({ timeout: 120_000 }), page.getByRole("alert").first().waitFor({ timeout: 120_000 })]);
  assert.equal(await page.getByRole("alert").count(), 0, (await page.getByRole("alert").allInnerTexts()).join("; "));
  const saved = async (button) => {
    const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: button }).filter({ visible: true }).click()]);
    return readFileSync(await download.path(), "utf8");
  };
  return { toml: await saved("Save as TOML"), yaml: await saved("Save for diff_drive_controller"), report: await saved("Save the report") };
}

/** [parameters] of calib.toml. */
function factors_in(toml) {
  const number = (name) => Number(new RegExp(`^${name} *= *(\\S+)`, "m").exec(toml)[1]);
  return { c_R: number("c_R"), c_L: number("c_L"), b: number("b") };
}

/** As the command line finds them from the same files. */
function expect_like_command_line(found, words) {
  run(astrolabe, "calibrate", ...words, "--out", in_folder("calib.toml"));
  const expected = factors_in(readFileSync(in_folder("calib.toml"), "utf8"));
  const of_page = factors_in(found.toml);
  for (const name of Object.keys(expected)) {
    const apart = Math.abs(of_page[name] / expected[name] - 1);
    // Sines and logarithms of both C libraries may differ in a last digit, which the search for the best fit passes on.
    assert.ok(apart < 1e-12, `${name} is ${of_page[name]} in the page and ${expected[name]} on the command line`);
  }
  console.log(`factors of page and command line: ${JSON.stringify(of_page)}, ${JSON.stringify(expected)}`);
  rmSync(in_folder("calib.toml"));
}

const files_of = (names) => names.flatMap((name) => ["--wheels", in_folder(`${name}-wheels.csv`), "--truth", in_folder(`${name}-truth.csv`)]);

test("tables of wheels and tracker that are dropped in give the command line's factors, and three files to save", async () => {
  await in_browser("#data", {}, async (page) => {
    assert.match(await page.locator("main").innerText(), /Nothing leaves this computer/);
    await drop(page, simulated.flatMap((name) => [in_folder(`${name}-truth.csv`), in_folder(`${name}-wheels.csv`)]));
    await enter_sizes(page, { diameter_mm: 72, counts: 2803.2, wheelbase_mm: 290 });
    const found = await calibrated(page);
    expect_like_command_line(found, ["files", ...files_of(simulated), "--wheel-diameter", "0.072", "--counts-per-turn", "2803.2", "--wheelbase", "0.29"]);
    assert.match(found.yaml, /wheel_separation_multiplier/);
    assert.match(found.report, /<html/i);
    await page.frameLocator("iframe[title=Report]").locator("h1").waitFor({ timeout: 60_000 });
  });
});

test("bags that are dropped in give the command line's factors, with the sizes that were recorded in them", async () => {
  await in_browser("#data", {}, async (page) => {
    const bags = simulated.map((name) => in_folder(`${name}.db3`));
    await drop(page, bags);
    expect_like_command_line(await calibrated(page), ["bag", ...bags]);
  });
});

test("a column with a misleading name is mended by its menu", async () => {
  const misnamed = simulated.map((name) => {
    const rows = readFileSync(in_folder(`${name}-wheels.csv`), "utf8").trim().split("\n").map((line) => line.split(","));
    const [time, left, right] = ["__time", "/odom/left_counts", "/odom/right_counts"].map((column) => rows[0].indexOf(column));
    const file = in_folder(`${name}-misnamed.csv`);
    const lines = rows.slice(1).map((row) => `${row[time]},${row[left]},${row[right]}\n`);
    writeFileSync(file, `time_s,channel A,channel B\n${lines.join("")}`);
    return file;
  });
  await in_browser("#data", {}, async (page) => {
    await drop(page, [...misnamed, ...simulated.map((name) => in_folder(`${name}-truth.csv`))]);
    const menu = (column) => page.getByRole("region", { name: "Columns of the wheels" }).getByLabel(`${column} is`, { exact: true });
    // First the wrong way round, as somebody guesses who does not know the cables.
    await menu("channel A").selectOption("right_counts");
    await menu("channel B").selectOption("left_counts");
    await looked(page, misnamed.length + simulated.length);
    await enter_sizes(page, { diameter_mm: 72, counts: 2803.2, wheelbase_mm: 290 });
    await page.getByRole("button", { name: "Calibrate", exact: true }).click();
    // The tracker turns against such wheels. The files themselves are in order.
    await page.getByRole("button", { name: "Left and right are exchanged in the files" }).waitFor({ timeout: 60_000 });
    assert.equal(await page.getByRole("alert").count(), 1);
    await menu("channel A").selectOption("left_counts");
    await menu("channel B").selectOption("right_counts");
    await looked(page, misnamed.length + simulated.length);
    expect_like_command_line(await calibrated(page), ["files", ...files_of(simulated), "--wheel-diameter", "0.072", "--counts-per-turn", "2803.2", "--wheelbase", "0.29"]);
  });
});

const sizes = { diameter_mm: 72, counts: 2803.2, wheelbase_mm: 290 };
const tables_of = (name) => [in_folder(`${name}-wheels.csv`), in_folder(`${name}-truth.csv`)];

test("what is stated while a calibration is computed keeps its answer off the page", async () => {
  await in_browser("#data", {}, async (page) => {
    await drop(page, tables_of(simulated[0]));
    await enter_sizes(page, sizes);
    await looked(page, 2);
    // One after the other in the page's own time, so that the answer cannot come between them.
    await page.evaluate(() => {
      [...document.querySelectorAll("button")].find((each) => each.textContent === "Calibrate").click();
      const wheelbase = document.getElementById("statement-wheelbase");
      wheelbase.value = "150";
      wheelbase.dispatchEvent(new Event("input", { bubbles: true }));
    });
    // The worker answers one question after the other: once it has looked at the files again, it has calibrated.
    await looked(page, 2);
    assert.equal(await page.getByRole("region", { name: "Result" }).filter({ visible: true }).count(), 0);
    await enter_sizes(page, sizes);
    await looked(page, 2);
    expect_like_command_line(await calibrated(page), ["files", ...files_of(simulated.slice(0, 1)), "--wheel-diameter", "0.072", "--counts-per-turn", "2803.2", "--wheelbase", "0.29"]);
  });
});

/** The question of the last call of this name that the page sent to its worker. */
const questions_seen = () => {
  const seen = [];
  const post = Worker.prototype.postMessage;
  Worker.prototype.postMessage = function (message, ...rest) {
    if (message.kind === "ask") seen.push(message);
    return post.call(this, message, ...rest);
  };
  globalThis.asked = (call) => seen.filter((each) => each.call === call).at(-1)?.question;
};

test("a statement goes with the files whose menu it was", async () => {
  await in_browser("#data", { init: questions_seen }, async (page) => {
    const bag = in_folder(`${simulated[0]}.db3`);
    await drop(page, [bag, ...tables_of(simulated[1])]);
    await page.getByText("Other guesses").click();
    await page.getByLabel("Each row is the travel since the row before").check();
    await page.getByLabel("Wheels in the bag").selectOption({ index: 1 });
    await looked(page, 3);
    const stated = await page.evaluate(() => globalThis.asked("inspect"));
    assert.ok(stated.per_interval && stated.wheels_topic, JSON.stringify(stated));
    await page.getByRole("button", { name: `Take ${simulated[1]}-wheels.csv away` }).click();
    await page.getByRole("button", { name: `Take ${simulated[0]}.db3 away` }).click();
    await looked(page, 1);
    assert.deepEqual(await page.evaluate(() => globalThis.asked("inspect")), { files: [`${simulated[1]}-truth.csv`], roles: {} });
    await drop(page, [bag]);
    await looked(page, 2);
    assert.equal(await page.evaluate(() => globalThis.asked("inspect").wheels_topic), undefined);
  });
});

test("files of the same name from two folders are two files", async () => {
  await in_browser("#data", {}, async (page) => {
    const folders = simulated.slice(0, 2).map((name, i) => {
      const drive = in_folder(`drive-${i}`);
      mkdirSync(drive);
      cpSync(in_folder(`${name}-wheels.csv`), path.join(drive, "wheels.csv"));
      cpSync(in_folder(`${name}-truth.csv`), path.join(drive, "truth.csv"));
      return [path.join(drive, "wheels.csv"), path.join(drive, "truth.csv")];
    });
    await drop(page, folders[0]);
    await drop(page, folders[0]);
    assert.equal(await page.locator("tr.file").count(), 2, "the same file again is no second one");
    await drop(page, folders[1]);
    await looked(page, 4);
    assert.match(await page.locator("main").innerText(), /There is another wheels\.csv already, so the new one is called wheels \(2\)\.csv/);
    await enter_sizes(page, sizes);
    expect_like_command_line(await calibrated(page), ["files", ...files_of(simulated.slice(0, 2)), "--wheel-diameter", "0.072", "--counts-per-turn", "2803.2", "--wheelbase", "0.29"]);
  });
});

test("a file that does not fit into the page's memory is refused in a sentence, and others are read", async () => {
  const large = path.join(folder, "large.csv");
  writeFileSync(large, "");
  truncateSync(large, 1.2e9); // takes no room on the disk
  await in_browser("#data", {}, async (page) => {
    await page.getByLabel("Drop files").setInputFiles(large);
    await page.getByRole("alert").getByText("'large.csv' (1.20 GB) does not fit into this page's memory").waitFor({ timeout: 60_000 });
    await page.getByLabel("Drop files").setInputFiles(drive_files());
    await page.getByRole("heading", { name: "Drives" }).waitFor({ timeout: 60_000 });
  });
});

test("one of several controllers and one of several robots are chosen by menus", async () => {
  const controllers = in_folder("controllers.yaml");
  writeFileSync(controllers, "odd:\n  ros__parameters:\n    wheel_separation: 0.5\n    wheel_radius: 0.09\nreal:\n  ros__parameters:\n    wheel_separation: 0.29\n    wheel_radius: 0.036\n");
  const other = in_folder("other.toml");
  writeFileSync(other, "[parameters]\nwheel_diameter = 0.2\ncounts_per_motor_rev = 10\nb = 1\n");
  await in_browser("#data", { init: questions_seen }, async (page) => {
    await drop(page, [other, controllers, ...tables_of(simulated[0])]);
    await page.getByLabel("File with the robot's sizes").selectOption("controllers.yaml");
    await page.getByLabel("Controller in that file").selectOption("real");
    await looked(page, 4);
    await enter_sizes(page, { counts: sizes.counts });
    await looked(page, 4);
    assert.match(await page.getByRole("row", { name: /controllers\.yaml/ }).innerText(), /wheel diameter 72 mm, wheelbase 290 mm/);
    expect_like_command_line(await calibrated(page), ["files", ...files_of(simulated.slice(0, 1)), "--robot", controllers, "--controller", "real", "--counts-per-turn", "2803.2"]);
  });
});

test("which frames of a bag are the ground truth is chosen by a menu", async (context) => {
  const bag = path.join(shared_data, "samples/rosbag2/tf_example/tf_example.db3");
  if (!existsSync(bag)) return context.skip(`not at hand: ${bag}`);
  await in_browser("#data", {}, async (page) => {
    await drop(page, [bag]);
    await page.getByLabel("tf_example.db3 is").selectOption("truth");
    await page.getByRole("alert").getByRole("button", { name: "Its frames, parent to child" }).click();
    const frames = page.getByLabel("Its frames, parent to child");
    assert.ok(await frames.evaluate((menu) => menu === document.activeElement), "the remedy leads to the menu");
    await frames.selectOption("odom to base_footprint");
    await looked(page, 1);
    assert.equal(await page.getByRole("alert").count(), 0);
    assert.match(await page.locator("tr.file").innerText(), /base_footprint/);
  });
});

test("a module that does not come is told at every question, and not waited for", async () => {
  for (const missing of ["**/astrolabe.mjs", "**/wasm_worker*.js"])
    await in_browser("#try", { may_complain: () => true, without: missing }, async (page) => {
      for (let i = 0; i < 2; ++i) {
        await page.getByRole("button", { name: "Drive and calibrate" }).click();
        await page.getByRole("alert").waitFor({ timeout: 60_000 });
      }
    });
});

test("the log of a laser scanner gives the command line's factors", async (context) => {
  const log = path.join(shared_data, "carmen/intel-corrected.log.gz");
  if (!existsSync(log)) return context.skip(`not at hand: ${log}`);
  await in_browser("#data", {}, async (page) => {
    await drop(page, [log]);
    await enter_sizes(page, { wheelbase_mm: 400 });
    await looked(page, 1);
    await page.getByRole("button", { name: "Calibrate", exact: true }).click();
    await page.getByRole("region", { name: "Result" }).filter({ visible: true }).waitFor({ timeout: 120_000 });
    const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Save as TOML" }).click()]);
    expect_like_command_line({ toml: readFileSync(await download.path(), "utf8") }, ["files", "--wheels", log, "--truth", `scan:${log}`, "--wheelbase", "0.4"]);
  });
});

test("raw drives of a real robot give the command line's factors", async (context) => {
  const source = path.join(shared_data, "sousa_optiodom/square/231220200029");
  if (!existsSync(source)) return context.skip(`not at hand: ${source}`);
  const runs = [1, 2, 3, 4, 5, 6].map((run) => path.join(source, `231220200029_run-0${run}`));
  await in_browser("#data", {}, async (page) => {
    await drop(page, runs.flatMap((run) => [`${run}_odo.csv`, `${run}_opti.csv.gz`]));
    const menu = (column) => page.getByRole("region", { name: "Columns of the wheels" }).getByLabel(`column ${column} is`, { exact: true });
    await menu(1).selectOption("time_s");
    await menu(2).selectOption("left_counts");
    await menu(3).selectOption("right_counts");
    await page.getByText("Other guesses").click();
    await page.getByLabel("Each row is the travel since the row before").check();
    await looked(page, 12);
    await enter_sizes(page, { diameter_mm: 84, counts: 2796.8, wheelbase_mm: 200 });
    const found = await calibrated(page);
    const words = runs.flatMap((run) => ["--wheels", `${run}_odo.csv`, "--truth", `${run}_opti.csv.gz`]);
    expect_like_command_line(found, ["files", ...words, "--wheel-columns", "time_s,left_counts,right_counts", "--per-interval",
      "--wheel-diameter", "0.084", "--counts-per-turn", "2796.8", "--wheelbase", "0.2"]);
  });
});
