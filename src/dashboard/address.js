/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines to copy ask the daemon that served this page. */
for (const lines of document.querySelectorAll('code.asks')) {
  lines.textContent = lines.textContent.replaceAll('http://127.0.0.1:8080', location.origin);
}
