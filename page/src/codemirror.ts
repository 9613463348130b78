/** CodeMirror 6 for TOML, loaded when the text is first used. */
import { autocompletion, completionKeymap, type CompletionContext, type CompletionResult } from '@codemirror/autocomplete';
import { defaultKeymap, indentWithTab } from '@codemirror/commands';
import { HighlightStyle, StreamLanguage, syntaxHighlighting } from '@codemirror/language';
import { toml } from '@codemirror/legacy-modes/mode/toml';
import { lintGutter, setDiagnostics } from '@codemirror/lint';
import { EditorState, Transaction } from '@codemirror/state';
import { drawSelection, EditorView, highlightActiveLine, keymap, lineNumbers } from '@codemirror/view';
import { tags } from '@lezer/highlight';
import type { Habits, Writing } from './editor';

const colours = HighlightStyle.define([
  { tag: tags.comment, color: 'var(--quiet)', fontStyle: 'italic' },
  { tag: [tags.string, tags.number, tags.bool, tags.atom], color: 'var(--literal)' },
  { tag: [tags.propertyName, tags.keyword, tags.heading, tags.tagName], color: 'var(--accent)' },
]);

export function codeMirror(habits: Habits, text: string): Writing {
  let told = true;
  const complete = async (context: CompletionContext): Promise<CompletionResult | null> => {
    if (!context.explicit && !context.matchBefore(/[\w".-]$/)) return null;
    const found = await habits.complete(context.state.doc.toString(), context.pos);
    if (!found || found.candidates.length === 0 || context.aborted) return null;
    return { from: found.from, to: found.to, options: found.candidates.map(({ label, detail, insert }) => ({ label, detail, apply: insert })) };
  };
  const view = new EditorView({
    state: EditorState.create({
      doc: text,
      extensions: [
        keymap.of([
          // The page's own history also knows sliders and drawings.
          { key: 'Mod-z', run: () => (habits.undo(), true), preventDefault: true },
          { key: 'Mod-y', mac: 'Mod-Shift-z', run: () => (habits.redo(), true), preventDefault: true },
          { key: 'Mod-Shift-z', run: () => (habits.redo(), true), preventDefault: true },
          // Tab indents; Escape, then Tab leaves the field, as CodeMirror's documentation advises.
          ...completionKeymap, indentWithTab, ...defaultKeymap,
        ]),
        lineNumbers(), drawSelection(), highlightActiveLine(), lintGutter(),
        StreamLanguage.define(toml), syntaxHighlighting(colours),
        autocompletion({ override: [complete] }),
        EditorView.contentAttributes.of({ 'aria-label': habits.label, tabindex: '0', spellcheck: 'false', autocapitalize: 'off' }),
        EditorView.updateListener.of((update) => {
          if (update.docChanged && told) habits.changed();
        }),
      ],
    }),
  });
  return {
    element: view.dom,
    get text() {
      return view.state.doc.toString();
    },
    set text(now: string) {
      told = false;
      view.dispatch({ changes: difference(view.state.doc.toString(), now), annotations: Transaction.addToHistory.of(false) });
      view.scrollDOM.scrollLeft = 0;
      told = true;
    },
    mark(places, message) {
      const length = view.state.doc.length;
      view.dispatch(setDiagnostics(view.state, places.map(({ from, to, label }) => ({
        from: Math.min(from, length),
        to: Math.min(Math.max(to, from), length),
        severity: 'error',
        message: label === '' ? message : `${message}\n${label}`,
      }))));
    },
    select(from, to) {
      view.dispatch({ selection: { anchor: Math.min(from, view.state.doc.length), head: Math.min(to, view.state.doc.length) }, scrollIntoView: true });
    },
    focus: () => view.focus(),
  };
}

/** The part that differs, so that the cursor and the view stay. */
function difference(old: string, now: string): { from: number; to: number; insert: string } {
  let from = 0;
  const most = Math.min(old.length, now.length);
  while (from < most && old[from] === now[from]) from++;
  let end = 0;
  while (end < most - from && old[old.length - 1 - end] === now[now.length - 1 - end]) end++;
  return { from, to: old.length - end, insert: now.slice(from, now.length - end) };
}
