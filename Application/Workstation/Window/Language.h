#pragma once

#include <QLocale>
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

/// Texts of the program and of Qt's own dialogs, and numbers, for windows that are made afterwards.
/// English installs nothing.
void installLanguage(QCoreApplication& application, const QString& code);

/// Code of the language whose texts are installed.
QString shownLanguage();

/// How the window's language writes numbers: German with a decimal comma, English with a point,
/// neither with marks between thousands. Whatever the session's locale is.
QLocale numberLocale();
/// Makes that the default of Qt, for the fields that are made afterwards.
void useNumberLocale();

} // namespace petrous::workstation
