/** How the element looks. A constructed sheet: a strict Content-Security-Policy lets it be. */
export function styles(): CSSStyleSheet {
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(`
:host { display: block; font: 16px/1.4 system-ui, sans-serif; }
[hidden] { display: none !important; }
.frame { display: grid; justify-items: center; }
canvas { display: none; aspect-ratio: var(--aspect, 1.33); width: min(100%, var(--height, 80vh) * var(--aspect, 1.33)); outline-offset: 2px; touch-action: pan-y; }
:host([data-shown]) canvas { display: block; }
:host([data-shown]) slot { display: none; }
:host(:fullscreen) { background: #000; color: #ddd; overflow: auto; }
:host(:fullscreen) canvas { --height: 100vh; }
.bar { display: flex; flex-wrap: wrap; gap: .8em; align-items: center; justify-content: center; margin: .6em 0 0; }
:host(:not([data-shown])) .bar { visibility: hidden; }
.bar button, .bar select, .bar label { font: inherit; }
.film { display: flex; gap: .8em; align-items: center; }
::slotted(video) { display: block; margin: 0 auto; max-width: 100%; max-height: 80vh; }
.said { margin: 0 auto; padding: .2em 1em; text-align: center; font-size: 1.2em; }
.said:empty { display: none; }
.how, .alarm { margin: .5em auto; max-width: 40em; text-align: center; min-height: 1.4em; }
.alarm:empty { display: none; }
.alarm { padding: .6em 1em; background: #fff3d6; color: #402c00; border-radius: .3em; }
`);
  return sheet;
}
