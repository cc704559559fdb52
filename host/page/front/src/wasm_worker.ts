import { sentence_of } from "./backend";
import type { FromWorker, ToWorker } from "./wasm_messages";

/** The module's surface (host/page/wasm/main.cpp). */
interface Module {
  answer(call: string, question: string, emit: (event: string) => void): string;
  FS: { mkdir(path: string): void; readFile(path: string): Uint8Array<ArrayBuffer>; writeFile(path: string, bytes: Uint8Array): void };
}

const kFolder = "/files-of-the-page";
const kStep_ms = 20;

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

/** What a robot does belongs to no question, whichever is being answered when it does it. */
function ask(module: Module, question_id: number, call: string, question: unknown): Answered {
  const id = call.startsWith("robot/") ? 0 : question_id;
  return JSON.parse(module.answer(call, JSON.stringify(question), (event) => post({ id, kind: "event", event: JSON.parse(event) }))) as Answered;
}

let clock = 0;

/** A simulated robot's time passes only when somebody asks for it. */
function let_time_pass(module: Module) {
  clock ||= setInterval(() => {
    ask(module, 0, "robot/step", { now_s: performance.now() / 1000 });
  }, kStep_ms) as unknown as number;
}

onmessage = async ({ data }: MessageEvent<ToWorker>) => {
  const { id } = data;
  try {
    const module = await loading;
    if (data.kind === "file") {
      post({ id, kind: "answer", answer: module.FS.readFile(`${kFolder}/${data.path}`) });
      return;
    }
    if (data.kind === "put") {
      module.FS.writeFile(`${kFolder}/${data.file.name}`, await bytes_of(data.file));
      post({ id, kind: "answer", answer: null });
      return;
    }
    const { result, error } = ask(module, id, data.call, data.question);
    if (error) post({ id, kind: "refusal", ...error });
    else post({ id, kind: "answer", answer: result });
    if (data.call === "robot/open") let_time_pass(module);
  } catch (error) {
    post({ id, kind: "refusal", sentence: sentence_of(error), remedies: [] });
  }
};
