// The module of the page, without a page: under node.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import os from "node:os";
import path from "node:path";
import { test } from "node:test";
import { brotliCompressSync, constants } from "node:zlib";
import { native_answers, page } from "./places.mjs";

/** Ten robots that differ in all their errors, so that each seed is another experiment. */
const questions = Array.from({ length: 10 }, (_, i) => ({
  call: "try_out",
  question: { seed: i + 1, runs: 2, E_d: 1 + 0.002 * (i - 4), E_b: 1 - 0.003 * (i - 5), S: 1 + 0.001 * i, e: 0.004 * i },
}));

async function new_module() {
  // Emscripten 3.1.6 takes node for one with CommonJS, and cannot read a file: address.
  globalThis.__dirname = page;
  globalThis.require = createRequire(import.meta.url);
  const { default: create } = await import(path.join(page, "astrolabe.mjs"));
  const module = await create({ wasmBinary: readFileSync(path.join(page, "astrolabe.wasm")) });
  module.FS.mkdir("/files-of-the-page");
  return module;
}

async function answers_of_module() {
  const module = await new_module();
  return questions.map(({ call, question }) => JSON.parse(module.answer(call, JSON.stringify(question), () => {}, 0)));
}

function answers_of_program() {
  const folder = mkdtempSync(path.join(os.tmpdir(), "page-answers-"));
  const asked = questions.map((each) => JSON.stringify(each) + "\n").join("");
  const ran = spawnSync(native_answers, [folder], { input: asked, encoding: "utf8", maxBuffer: 1 << 28 });
  rmSync(folder, { recursive: true });
  assert.equal(ran.status, 0, `${native_answers}: ${ran.error ?? ran.stderr}`);
  return ran.stdout.trim().split("\n").map((line) => JSON.parse(line));
}

test("ten robots are calibrated by the module as by this machine's own program", async () => {
  const module = await answers_of_module();
  const program = answers_of_program();
  assert.equal(program.length, questions.length);
  let farthest = 0;
  questions.forEach(({ question }, i) => {
    const of_module = module[i].result?.results.parameters.new;
    const of_program = program[i].result?.results.parameters.new;
    assert.ok(of_module && of_program, `seed ${question.seed}: ${JSON.stringify(module[i].error ?? program[i].error)}`);
    for (const name of ["c_R", "c_L", "b_m", "e"]) {
      const apart = Math.abs(of_module[name] - of_program[name]);
      farthest = Math.max(farthest, apart);
      // Both run the same firmware on integers; only their sine and logarithm may differ in a last digit.
      assert.ok(apart <= 1e-12, `seed ${question.seed}: ${name} is ${of_module[name]} and ${of_program[name]}`);
    }
  });
  console.log(`seeds ${questions[0].question.seed} to ${questions.at(-1).question.seed}: at most ${farthest} apart`);
});

test("a robot in the module drives while the page repeats its velocity, and rests when it does not", async () => {
  const module = await new_module();
  let state = null;
  let samples = 0;
  const ask = (call, question) => {
    const told = (text) => {
      const event = JSON.parse(text);
      if (event.event === "state") state = event;
      if (event.event === "samples") samples += event.t_s.length;
    };
    const answer = JSON.parse(module.answer(`robot/${call}`, JSON.stringify(question), told, 0));
    assert.ok(answer.result, `${call}: ${JSON.stringify(answer.error)}`);
    return answer.result;
  };
  let now_s = 100;
  const pass_s = (seconds, meanwhile) => {
    for (const end_s = now_s + seconds; now_s < end_s; ) {
      meanwhile();
      ask("step", { now_s: (now_s += 0.02) });
    }
  };
  assert.equal(ask("open", { simulated: { seed: 1 } }).simulated, true);
  ask("watch", { signals: ["v"], rate_hz: 1000 });
  ask("arm", {});
  pass_s(1, () => ask("drive", { v_mps: 0.3, w_radps: 0 }));
  assert.equal(state.moving, true);
  pass_s(2, () => {});
  assert.equal(state.moving, false);
  // Three seconds at 1 kHz; requests let a few milliseconds of the robot's time pass, too.
  assert.ok(Math.abs(samples - 3000) < 150, `${samples} samples`);
  ask("close", {});
});

test("the module comes over the network in at most 1.5 MB", () => {
  const packed = (name) => {
    const bytes = readFileSync(path.join(page, name));
    return brotliCompressSync(bytes, { params: { [constants.BROTLI_PARAM_LGWIN]: 24 } }).length;
  };
  const [wasm, around] = [packed("astrolabe.wasm"), packed("astrolabe.mjs")];
  console.log(`brotli: astrolabe.wasm ${wasm} bytes, astrolabe.mjs ${around} bytes`);
  assert.ok(wasm + around <= 1.5e6, `${wasm + around} bytes`);
});
