import type { Backend } from "./backend";
import { WasmBackend } from "./wasm_backend";
import { WebSocketBackend } from "./web_socket_backend";

const kToken = "astrolabe-token";

/** The token of the link by which a program opened this page. It is taken out of the address, where others may see it, and survives a reload. */
function token_of_link(): string | null {
  const token = new URLSearchParams(location.hash.slice(1)).get("token");
  if (token === null) return sessionStorage.getItem(kToken);
  sessionStorage.setItem(kToken, token);
  history.replaceState(null, "", "#live");
  return token;
}

/** The program that serves this page, or else the module in this browser. */
export function chosen_backends(): { calls: Backend; robot: Backend } {
  const token = token_of_link();
  if (token !== null) {
    const program = new WebSocketBackend(token);
    return { calls: program, robot: program };
  }
  const calls = new WasmBackend(false);
  calls.start();
  // In a worker of its own, so that a robot is stopped at once while another question is computed.
  return { calls, robot: new WasmBackend(true) };
}
