// Where `./dev web test` has built the page and what it is compared with.
import { createRequire } from "node:module";
import path from "node:path";
import { fileURLToPath } from "node:url";

const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), "../../../..");

export const page = path.join(root, "build/page");
export const native_programs = path.join(root, "build/host/tests");
export const native_answers = path.join(native_programs, "page_answers");
/** Programs for node on the module's processor. */
export const node_programs = path.join(root, "build/web/tests");
export const astrolabe = path.join(root, "build/host/bin/astrolabe");
export const shared_data = path.join(root, "../shared/data");
/** The npm packages of the page, which are installed where it is built. */
export const library = createRequire(path.join(root, "build/web/host/page/front/package.json"));
