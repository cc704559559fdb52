import type { Backend, Event_ } from "./backend";
import { OpenQuestions } from "./open_questions";

const kAgain_ms = 1000;
/** Whoever says a wrong token is told so, and need not ask again. */
const kRefused = 1008;
const kGone = "the program that serves this page does not answer; if it was started again, open the link that it prints";

interface FromProgram {
  id: number;
  event?: Event_;
  answer?: { result?: unknown; error?: { sentence: string; remedies?: string[] } };
}

/** The program that serves this page (host/live/dashboard), over a WebSocket whose first message is the token of the page's link. */
export class WebSocketBackend implements Backend {
  readonly has_ports = true;
  private socket: WebSocket | null = null;
  private admitted = false;
  private unsent: string[] = [];
  private questions = new OpenQuestions();

  constructor(private token: string) {
    this.connect();
  }

  ask<Answer>(call: string, question: unknown, told?: (event: Event_) => void): Promise<Answer> {
    return this.questions.ask<Answer>((id) => this.send(JSON.stringify({ id, call, question })), told);
  }

  listen(told: (event: Event_) => void) {
    return this.questions.listen(told);
  }

  async file(path: string): Promise<Blob> {
    return (await this.fetch(path, {})).blob();
  }

  async put(file: File): Promise<void> {
    await this.fetch(file.name, { method: "PUT", body: file });
  }

  private async fetch(path: string, options: RequestInit): Promise<Response> {
    const names = path.split("/").map(encodeURIComponent).join("/");
    const response = await fetch(`files/${names}`, { ...options, headers: { Authorization: `Bearer ${this.token}` } });
    if (!response.ok) throw new Error(`${path}: ${(await response.text()).trim()}`);
    return response;
  }

  private send(text: string) {
    if (this.admitted) this.socket!.send(text);
    else if (this.socket) this.unsent.push(text);
    else this.questions.refuse_all(kGone);
  }

  private connect() {
    const address = new URL("calls", document.baseURI);
    address.protocol = address.protocol.replace("http", "ws");
    address.hash = "";
    const socket = new WebSocket(address);
    this.socket = socket;
    socket.onopen = () => socket.send(JSON.stringify({ token: this.token }));
    socket.onmessage = ({ data }: MessageEvent<string>) => this.take(JSON.parse(data) as FromProgram);
    socket.onclose = ({ code, reason }) => {
      this.socket = null;
      this.admitted = false;
      this.unsent = [];
      const why = reason || kGone;
      this.questions.refuse_all(why);
      this.questions.tell(0, { event: "connection", up: false, why });
      if (code !== kRefused) setTimeout(() => this.connect(), kAgain_ms);
    };
  }

  private take({ id, event, answer }: FromProgram) {
    if (event) this.questions.tell(id, event);
    else if (id === 0) this.admit();
    else if (answer?.error) this.questions.refuse(id, answer.error.sentence, answer.error.remedies);
    else this.questions.answer(id, answer?.result);
  }

  private admit() {
    this.admitted = true;
    for (const text of this.unsent.splice(0)) this.socket!.send(text);
    this.questions.tell(0, { event: "connection", up: true });
  }
}
