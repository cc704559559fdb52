import "@picocss/pico/css/pico.min.css";
import "./page.css";
import { render } from "preact";
import { TryPage } from "./try_page";
import { WasmBackend } from "./wasm_backend";

const backend = new WasmBackend();

function Page() {
  return (
    <main class="container">
      <TryPage backend={backend} />
    </main>
  );
}

render(<Page />, document.getElementById("page")!);
