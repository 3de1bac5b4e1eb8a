#pragma once

#include <QString>
#include <QStringList>

class QCoreApplication;

namespace petrous::workstation
{

/// The window's language, by its code of ISO 639-1: "en", as the sources have it, or one whose
/// translations are built in.
bool hasLanguage(const QString& code);

/// `chosen` where the window has it; else (also when empty) the first of the user's languages where
/// the window has that, and English where it has not. `users`: QLocale::uiLanguages().
QString languageOf(const QString& chosen, const QStringList& users);

/// Texts of the program and of Qt's own dialogs, for windows that are made afterwards. Numbers do
/// not change. English installs nothing.
void installLanguage(QCoreApplication& application, const QString& code);

/// Code of the language whose texts are installed.
QString shownLanguage();

} // namespace petrous::workstation
