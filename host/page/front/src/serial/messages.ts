/** What the worker and the page agree on of a serial port, which only the page can open. */
export const kOpening = 0;
export const kOpen = 1;
/** The state once it is closed, and why: what follows "the port". */
export const kWhyClosed: Record<number, string> = {
  2: "is not there any more: plug the cable in, or choose another port",
  3: "could not be opened: another program or page may have it",
  4: "was closed",
};
export const [kMissing, kRefused, kClosed] = [2, 3, 4] as const;

export type ToPort = { kind: "open_port"; name: string } | { kind: "write_port"; bytes: Uint8Array<ArrayBuffer> } | { kind: "close_port" };
