import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { test } from 'node:test';
import { images, print, symbols } from './bench.mjs';

// The image, without running it.
const text = execFileSync('arm-none-eabi-objdump', ['-d', '--no-show-raw-insn', `${images}/astrolabe-rp2040.elf`], { encoding: 'utf8', maxBuffer: 1 << 28 });

// Functions by name: { frame, calls, pointers, opcodes }. A frame is all that a function's own instructions take from the stack
// on all its ways together, which is more than it can take.
function functionsOf(listing) {
  const words = new Map([...listing.matchAll(/^\s*([0-9a-f]+):\t\.word\t0x([0-9a-f]+)/gm)].map(([, at, value]) => [at, parseInt(value, 16) | 0]));
  const functions = new Map();
  let now = null, loaded = {};
  for (const line of listing.split('\n')) {
    const head = /^[0-9a-f]+ <(.+)>:$/.exec(line);
    if (head) {
      now = { frame: 0, calls: new Set(), pointers: 0, opcodes: new Set() };
      functions.set(head[1], now);
      loaded = {};
      continue;
    }
    const found = /^\s*[0-9a-f]+:\t(\S+)(?:\t(.*))?$/.exec(line);
    if (!found || !now || found[1].startsWith('.')) continue;
    const [, opcode, operands = ''] = found;
    now.opcodes.add(opcode);
    if (opcode === 'push') {
      const list = operands.replace(/[{}]/g, '').split(',').map((name) => name.trim());
      now.frame += 4 * list.reduce((sum, name) => { const range = /^r(\d+)-r(\d+)$/.exec(name); return sum + (range ? range[2] - range[1] + 1 : 1); }, 0);
    }
    const taken = /^sp, (?:sp, )?#(\d+)/.exec(operands);
    if (opcode === 'sub' && taken) now.frame += Number(taken[1]);
    const written = /^(r\d+)/.exec(operands);
    if (written && opcode !== 'cmp' && opcode !== 'str') delete loaded[written[1]]; // no longer the constant
    const constant = /^(r\d+), \[pc, #\d+\]\s*@ \(([0-9a-f]+)/.exec(operands);
    if (opcode === 'ldr' && constant) loaded[constant[1]] = words.get(constant[2]);
    const variable = /^sp, (r\d+)$/.exec(operands);
    if (opcode === 'add' && variable) {
      const bytes = loaded[variable[1]];
      // The same is given back at the end by a constant that is computed.
      if (bytes === undefined && !now.large) throw new Error(`a frame of unknown size: ${line}`);
      if (bytes < 0) {
        now.frame -= bytes;
        now.large = true;
      }
    }
    const target = /^[0-9a-f]+ <([^+>]+)>$/.exec(operands.trim());
    if (target && /^(bl|b(\.n|\.w)?)$/.test(opcode) && functions.get(target[1]) !== now) now.calls.add(target[1]);
    if (opcode === 'blx') ++now.pointers;
  }
  return functions;
}

const kRom_bytes = 256; // assumed of the boot ROM's functions, which are small
// THE list of calls through pointers: what each function that makes some may call.
const kPointers = [
  [/^start_from_flash$/, ['_ZN5astro6rp204012_GLOBAL__N_13runEv']],
  [/timer_interrupt/, ['_ZZ4mainENUlvE_4_FUNEv']],
  [/rp2040.*(Commands|Flash5erase|program_page|Flash13serial)|Restart.*restart|System16enter_bootloader|RobotINS_6rp20405BoardEEC2/, ['ROM']],
  [/N_13runEv$/, ['constructors']],
];

function deepest(functions, from, path = []) {
  if (from === 'ROM') return { bytes: kRom_bytes, path: ['the boot ROM'] };
  if (from === 'constructors') return { bytes: 0, path: [] };
  if (path.includes(from)) throw new Error(`recursion: ${[...path, from].join(' -> ')}`);
  const one = functions.get(from);
  if (!one) throw new Error(`${from} is not in the image`);
  if (one.deepest) return one.deepest;
  let calls = [...one.calls];
  if (one.pointers) {
    const known = kPointers.find(([name]) => name.test(from));
    if (!known) throw new Error(`${from} calls through a pointer that this test does not know`);
    calls = [...calls, ...known[1]];
  }
  const below = calls.map((name) => deepest(functions, name, [...path, from])).reduce((a, b) => (b.bytes > a.bytes ? b : a), { bytes: 0, path: [] });
  one.deepest = { bytes: one.frame + below.bytes, path: [from, ...below.path] };
  return one.deepest;
}

test('no float, no heap and nothing else of a library but division, shifts and the family of memcpy', () => {
  const allowed = /^(__aeabi_(idiv0|ldiv0|ldivmod|uldivmod|llsl|llsr|lasr|lmul|uidiv|uidivmod|idiv|idivmod)|__(ash|lsh|ash?r)\w*di3|__clz[sd]i2|__divdi3|__divsi3|__muldi3|__gnu_ldivmod_helper|__udivmoddi4|__udivsi3|mem(chr|cmp|cpy|move|set))$/;
  const own = /^_Z|^(main|reset|second_stage|start_from_flash|fault_handler|end_by_fault)$/;
  const others = [...functionsOf(text).keys()].filter((name) => !own.test(name) && !allowed.test(name));
  assert.deepEqual(others, []);
  assert.ok(allowed.test('__aeabi_lmul') && !allowed.test('__aeabi_fadd') && !allowed.test('malloc') && !own.test('_sbrk'));
});

test('no breakpoint and no instruction that is undefined', () => {
  for (const [name, { opcodes }] of functionsOf(text)) assert.ok(!opcodes.has('bkpt') && !opcodes.has('udf') && !opcodes.has('svc'), name);
});

test('nothing is called outside the flash before the program has been copied', () => {
  const { calls } = functionsOf(text).get('start_from_flash');
  assert.deepEqual([...calls], []);
});

test('no recursion, and the worst case of the stack fits what is reserved for it', () => {
  const functions = functionsOf(text);
  assert.equal(symbols.get('constructors_start'), symbols.get('constructors_end'), 'there are no constructors to call');
  const kStored = 32 + 4; // by the core when an interrupt comes, and to align it
  const parts = [deepest(functions, 'start_from_flash')];
  for (const handler of [/rp2040.*timer_interrupt/, /rp2040.*Uart9interrupt/, /UsbSerial.*9interruptEv$/]) {
    const name = [...functions.keys()].find((one) => handler.test(one));
    assert.ok(name, `${handler}`);
    parts.push(deepest(functions, name));
  }
  const worst = parts.reduce((sum, { bytes }) => sum + bytes, 0) + (parts.length - 1) * kStored;
  const reserved = symbols.get('stack_top') - symbols.get('stack_bottom');
  print(`stack: main program ${parts[0].bytes}, tick ${parts[1].bytes}, serial port ${parts[2].bytes}, USB ${parts[3].bytes}: worst case ${worst} of ${reserved} bytes`);
  print(`deepest: ${parts[0].path.join(' -> ').slice(0, 400)}`);
  assert.ok(worst <= reserved);
});

test('the checks see what breaks their rules', () => {
  const sample = (lines) => functionsOf(`20000000 <f>:\n${lines.map((line, i) => `20000${(0x100 + 2 * i).toString(16)}:\t${line}\n`).join('')}`);
  assert.equal(sample(['push\t{r4, r5, lr}', 'sub\tsp, #8']).get('f').frame, 20);
  assert.equal(sample(['push\t{r0-r3}']).get('f').frame, 16);
  assert.throws(() => sample(['add\tsp, r4']), /unknown size/);
  assert.equal(sample(['ldr\tr4, [pc, #4]\t@ (20000104 <f+0x4>)', 'add\tsp, r4', '.word\t0xfffffe00']).get('f').frame, 512);
  assert.throws(() => deepest(functionsOf('0 <f>:\n 0:\tbl\t10 <g>\n10 <g>:\n 10:\tbl\t0 <f>\n'), 'f'), /recursion/);
  assert.throws(() => deepest(sample(['blx\tr3']), 'f'), /does not know/);
});
