/** What the worker and the page agree on of a serial port, which only the page can open. */
export const [kOpening, kOpen, kMissing, kRefused, kClosed] = [0, 1, 2, 3, 4] as const;
const kStates = 8;

/** Each opening has a number, so that one that ends late is not taken for the next. */
export const state_of = (opening: number, state: number) => opening * kStates + state;

/** Why a port in this state cannot be used: what follows "the port". "" if it can. */
export function why_closed(state: number): string {
  switch (state % kStates) {
    case kOpen:
      return "";
    case kMissing:
      return "is not there: plug the cable in, or choose another port";
    case kRefused:
      return "could not be opened: another program or page may have it";
    case kClosed:
      return "was closed";
    default:
      return "does not open: unplug it for a moment";
  }
}

/** What a worker sent longer ago than this is not written: the page was busy, and a robot would obey a command of the past. */
export const kStale_ms = 250;

export type ToPort =
  | { kind: "open_port"; name: string; opening: number }
  | { kind: "write_port"; bytes: Uint8Array<ArrayBuffer>; sent_ms: number }
  | { kind: "close_port" };
