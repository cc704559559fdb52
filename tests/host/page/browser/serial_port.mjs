// A serial port as a browser gives it to a page that a person has let use it, with a robot behind a pty at its other end.
import { constants, openSync, writeSync } from "node:fs";
import tty from "node:tty";

/** In the page: navigator.serial with one port, whose bytes go through the functions that with_serial_port gives it. */
const fake_serial = () => {
  const kChosen = "port-was-chosen";
  let incoming;
  globalThis.bytes_have_come = (bytes) => incoming?.enqueue(Uint8Array.from(bytes));
  globalThis.cable_is_pulled = () => {
    port.readable = null;
    incoming?.error(new DOMException("The device has been lost.", "NetworkError"));
  };
  const port = {
    readable: null,
    writable: null,
    getInfo: () => ({ usbVendorId: 0x16c0, usbProductId: 0x0483 }),
    async open() {
      if (!(await globalThis.open_the_port())) throw new DOMException("Failed to open serial port.", "NetworkError");
      this.readable = new ReadableStream({ start: (controller) => void (incoming = controller) });
      this.writable = new WritableStream({ write: (bytes) => globalThis.write_to_port([...bytes]) });
    },
    setSignals: async () => {},
    async close() {
      await globalThis.close_the_port();
      incoming = this.readable = this.writable = null;
    },
  };
  Object.defineProperty(navigator, "serial", {
    value: Object.assign(new EventTarget(), {
      getPorts: async () => (sessionStorage.getItem(kChosen) ? [port] : []),
      requestPort: async () => {
        sessionStorage.setItem(kChosen, "1");
        return port;
      },
    }),
  });
};

/** Gives `page` a serial port at the end of the robot's pty, and loads it anew. */
export async function with_serial_port(page, robot) {
  let line;
  const close = () => {
    line?.removeAllListeners();
    line?.on("error", () => {}); // of a pty that has gone
    line?.destroy();
    line = undefined;
  };
  await page.exposeFunction("open_the_port", () => {
    close();
    try {
      const descriptor = openSync(robot.path, constants.O_RDWR | constants.O_NOCTTY | constants.O_NONBLOCK);
      line = new tty.ReadStream(descriptor);
      line.setRawMode(true);
      line.descriptor = descriptor;
    } catch {
      return false;
    }
    const gone = () => {
      close();
      void page.evaluate(() => globalThis.cable_is_pulled()).catch(() => {});
    };
    line.on("data", (bytes) => void page.evaluate((all) => globalThis.bytes_have_come(all), [...bytes]).catch(() => {}));
    line.on("error", gone);
    line.on("close", gone);
    return true;
  });
  await page.exposeFunction("write_to_port", (bytes) => void (line && writeSync(line.descriptor, Uint8Array.from(bytes))));
  await page.exposeFunction("close_the_port", close);
  await page.addInitScript(fake_serial);
  await page.reload();
}
