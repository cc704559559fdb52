import { useEffect, useRef } from "preact/hooks";

/** A question before something is done that people mostly do not want. It takes the focus, which stops a robot that is held. */
export function Confirm(props: { sentence: string; yes: string; decide: (yes: boolean) => void }) {
  const dialog = useRef<HTMLDialogElement>(null);
  useEffect(() => dialog.current!.showModal(), []);
  return (
    <dialog ref={dialog} aria-label="Please confirm" onCancel={(event) => { event.preventDefault(); props.decide(false); }}>
      <article>
        <p>{props.sentence}</p>
        <footer>
          <button type="button" class="secondary" autoFocus onClick={() => props.decide(false)}>
            Leave it
          </button>
          <button type="button" onClick={() => props.decide(true)}>
            {props.yes}
          </button>
        </footer>
      </article>
    </dialog>
  );
}
