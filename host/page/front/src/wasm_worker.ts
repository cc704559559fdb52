import type { FromWorker, ToWorker } from "./wasm_messages";

/** The module's surface (host/page/wasm/main.cpp). */
interface Module {
  answer(call: string, question: string, emit: (event: string) => void): string;
  FS: { mkdir(path: string): void; readFile(path: string): Uint8Array<ArrayBuffer>; writeFile(path: string, bytes: Uint8Array): void };
}

const kFolder = "/files-of-the-page";

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

const sentence_of = (error: unknown) => (error instanceof Error ? error.message : String(error));

onmessage = async ({ data }: MessageEvent<ToWorker>) => {
  const { id } = data;
  try {
    const module = await loading;
    if (data.kind === "file") {
      post({ id, kind: "file", bytes: module.FS.readFile(`${kFolder}/${data.path}`) });
      return;
    }
    if (data.kind === "put") {
      module.FS.writeFile(`${kFolder}/${data.file.name}`, await bytes_of(data.file));
      post({ id, kind: "answer", answer: null });
      return;
    }
    const answer = JSON.parse(
      module.answer(data.call, JSON.stringify(data.question), (event) =>
        post({ id, kind: "event", event: JSON.parse(event) }),
      ),
    );
    if (answer.error) post({ id, kind: "refusal", ...answer.error });
    else post({ id, kind: "answer", answer: answer.result });
  } catch (error) {
    post({ id, kind: "refusal", sentence: sentence_of(error), remedies: [] });
  }
};
