/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Light or dark: as the system has it, until the reader says otherwise. */
const root = document.documentElement;
const button = document.getElementById('theme');
const system = matchMedia('(prefers-color-scheme: dark)');

export function isDark() {
  return root.dataset.theme ? root.dataset.theme === 'dark' : system.matches;
}

function say() {
  button.textContent = isDark() ? 'Light' : 'Dark';
  button.setAttribute('aria-label', `Switch to ${isDark() ? 'light' : 'dark'} colours`);
  document.dispatchEvent(new CustomEvent('theme'));
}

try {
  const kept = localStorage.getItem('strum-theme');
  if (kept) root.dataset.theme = kept;
} catch { /* storage is switched off: the system's choice stays */ }
button.addEventListener('click', () => {
  root.dataset.theme = isDark() ? 'light' : 'dark';
  try {
    localStorage.setItem('strum-theme', root.dataset.theme);
  } catch { /* for this page only, then */ }
  say();
});
system.addEventListener('change', say);
say();
