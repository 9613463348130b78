/** Theme and language, kept between visits where the browser allows it. */
import { h } from './dom';
import { keep, recall } from './storage';
import { en, type Texts } from './texts';

export const LANGUAGES = { en: 'English', de: 'Deutsch', ru: 'Русский' } as const;
type Language = keyof typeof LANGUAGES;

/** Words in the language that was chosen, else in the first of the browser's that there is. */
export async function words(): Promise<{ language: Language; texts: Texts }> {
  const wanted = [recall('language'), ...navigator.languages].map((tag) => tag?.slice(0, 2));
  const language = (wanted.find((tag) => tag !== undefined && tag in LANGUAGES) ?? 'en') as Language;
  try {
    if (language === 'de') return { language, texts: (await import('./texts/de.json')).default };
    if (language === 'ru') return { language, texts: (await import('./texts/ru.json')).default };
  } catch {
    // Without a network and not kept: English is at hand.
  }
  return { language: 'en', texts: en };
}

export function applyTheme(theme = recall('theme') ?? 'system'): void {
  if (theme === 'system') delete document.documentElement.dataset['theme'];
  else document.documentElement.dataset['theme'] = theme;
}

/** The choices; `changed` is called after another theme, `say` if the browser does not keep one. */
export function choices(texts: Texts, language: Language, changed: () => void, say: (words: string) => void): HTMLElement {
  const choice = (name: string, now: string, options: [string, string][], chosen: (value: string) => void): HTMLElement => {
    const select = h('select', { 'aria-label': name }, ...options.map(([value, words]) => h('option', { value, selected: value === now }, words)));
    select.addEventListener('change', () => chosen(select.value));
    return select;
  };
  return h('div', { class: 'choices' },
    choice(texts.theme, recall('theme') ?? 'system', [['system', texts.themeSystem], ['light', texts.themeLight], ['dark', texts.themeDark]], (theme) => {
      if (!keep('theme', theme)) say(texts.notKept);
      applyTheme(theme);
      changed();
    }),
    choice(texts.languageChoice, language, Object.entries(LANGUAGES), (tag) => {
      if (keep('language', tag)) location.reload();
      else say(texts.notKept);
    }));
}
