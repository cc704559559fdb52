import { sentence_of } from "./backend";
import { KeptRecording, type ModuleFiles } from "./live/kept_recordings";
import { type RobotQuestion, type Rules, take_questions, WaitingQuestions } from "./serial/question_queue";
import { SerialLine } from "./serial/serial_line";
import { SharedBytes } from "./serial/shared_bytes";
import type { FromWorker, ToWorker } from "./wasm_messages";

/** The module's surface (host/page/wasm/main.cpp). */
interface Module extends Rules {
  answer(call: string, question: string, emit: (event: string) => void, waited_ms: number): string;
  serial?: SerialLine;
  FS: ModuleFiles & { mkdir(path: string): void; readFile(path: string): Uint8Array<ArrayBuffer>; writeFile(path: string, bytes: Uint8Array): void };
}

const kFolder = "/files-of-the-page";
const kStep_ms = 20;
/** A page that is closed loses what was driven since the last copy. */
const kCopy_ms = 1000;
/** Files are in memory, once here and once more while they are read; a browser gives a page a few gigabytes. */
const kMostBytes = 1e9;

async function load(): Promise<Module> {
  const address = new URL(/* @vite-ignore */ "../astrolabe.mjs", import.meta.url).href;
  const { default: create } = (await import(/* @vite-ignore */ address)) as { default: () => Promise<Module> };
  const module = await create();
  module.FS.mkdir(kFolder);
  return module;
}

const loading = load();
const post = (message: FromWorker) => postMessage(message);

async function bytes_of(file: File): Promise<Uint8Array> {
  try {
    return new Uint8Array(await file.arrayBuffer());
  } catch {
    throw new Error(`'${file.name}' cannot be read here: if it is a folder, drop the files that are in it`);
  }
}

interface Answered {
  result?: unknown;
  error?: { sentence: string; remedies: string[] };
}

/** Tells the person something that belongs to no question. */
const notice = (sentence: string) => post({ id: 0, kind: "event", event: { event: "notice", sentence } });

/** What a robot does belongs to no question, whichever is being answered when it does it. */
function ask(module: Module, question_id: number, call: string, question: unknown, waited_ms = 0): Answered {
  const id = call.startsWith("robot/") ? 0 : question_id;
  return JSON.parse(module.answer(call, JSON.stringify(question), (event) => post({ id, kind: "event", event: JSON.parse(event) }), waited_ms)) as Answered;
}

const refuse = (id: number, sentence: string) => post({ id, kind: "refusal", sentence, remedies: [] });

function answer(module: Module, { id, call, question, asked_ms }: RobotQuestion) {
  try {
    const { result, error } = ask(module, id, call, question, Math.max(0, Date.now() - asked_ms));
    if (error) post({ id, kind: "refusal", ...error });
    else post({ id, kind: "answer", answer: result });
    if (call === "robot/open") let_time_pass(module);
    if (!error) keep_recordings(module, call, question, result).catch((why: unknown) => notice(sentence_of(why)));
  } catch (why) {
    refuse(id, sentence_of(why));
  }
}

/** What the page shares, if it may. */
let shared: { line: SharedBytes; questions: SharedBytes } | undefined;

/** Answers the questions that wait in shared memory; those that come while one is answered are answered from within that. */
function look(module: Module) {
  if (!module.serial) {
    const { line, questions } = shared!;
    const waiting = new WaitingQuestions(questions, module, ({ id }) => refuse(id, "it was not carried out: the robot was stopped"));
    module.serial = new SerialLine(line, (message) => post({ id: 0, ...message }), () => {
      for (let next; (next = waiting.next()); ) answer(module, next);
    });
  }
  module.serial.meanwhile();
}

let kept: KeptRecording[] = [];

/** What is recorded is kept until a person removes it. */
async function keep_recordings(module: Module, call: string, question: unknown, result: unknown) {
  if (call === "robot/record" && (question as { on?: boolean }).on) {
    const recording = await KeptRecording.of(module.FS, `${kFolder}/${(result as { file: string }).file}`);
    if (recording) kept.push(recording);
    else notice("This browser keeps nothing for this page, as in a private window: what is recorded is lost with the page unless you save it before.");
  } else if (call === "robot/remove_recording") {
    const { file } = question as { file: string };
    const removed = kept.filter((each) => each.name === file);
    kept = kept.filter((each) => each.name !== file);
    for (const each of removed) await each.drop();
  }
  for (const each of kept) each.copy();
}

/** Bytes of the files that somebody gave, by their names. */
const given = new Map<string, number>();

function require_room(file: File) {
  let others = 0;
  for (const [name, bytes] of given) if (name !== file.name) others += bytes;
  if (others + file.size <= kMostBytes) return;
  const size = `${(file.size / 1e9).toFixed(2)} GB`;
  throw new Error(`'${file.name}' (${size}) does not fit into this page's memory, which has room for ${kMostBytes / 1e9} GB of files: load the page anew if it holds others, take a shorter part, or use the installed program`);
}

let clock = 0;
let copying = 0;

/** A simulated robot's time passes only when somebody asks for it. */
function let_time_pass(module: Module) {
  clock ||= setInterval(() => {
    ask(module, 0, "robot/step", { now_s: performance.now() / 1000 });
  }, kStep_ms) as unknown as number;
  copying ||= setInterval(() => {
    for (const each of kept) each.copy();
  }, kCopy_ms) as unknown as number;
}

onmessage = async ({ data }: MessageEvent<ToWorker>) => {
  const { id } = data;
  if (data.kind === "share") {
    shared = { line: new SharedBytes(data.line), questions: new SharedBytes(data.questions) };
    return;
  }
  try {
    const module = await loading;
    if (data.kind === "file") {
      post({ id, kind: "answer", answer: module.FS.readFile(`${kFolder}/${data.path}`) });
      return;
    }
    if (data.kind === "put") {
      require_room(data.file);
      module.FS.writeFile(`${kFolder}/${data.file.name}`, await bytes_of(data.file));
      given.set(data.file.name, data.file.size);
      post({ id, kind: "answer", answer: null });
      return;
    }
    if (data.kind === "look") look(module);
    else answer(module, data);
  } catch (error) {
    refuse(id, sentence_of(error));
    if (data.kind === "look") for (const each of take_questions(shared!.questions)) refuse(each.id, sentence_of(error));
  }
};
