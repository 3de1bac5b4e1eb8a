#include "Language.h"

#include <memory>

#include <QCoreApplication>
#include <QFile>
#include <QLibraryInfo>
#include <QTranslator>

namespace petrous::workstation
{

namespace
{

QString textsOf(const QString& code)
{
  return ":/translations/petrous_" + code + ".qm";
}

} // namespace

bool hasLanguage(const QString& code)
{
  return code == "en" || (!code.isEmpty() && QFile::exists(textsOf(code)));
}

QString languageOf(const QString& chosen, const QStringList& users)
{
  if (hasLanguage(chosen))
    return chosen;
  const QString first = users.value(0).section(QRegExp("[-_]"), 0, 0);
  return hasLanguage(first) ? first : "en";
}

void installLanguage(QCoreApplication& application, const QString& code)
{
  if (code == "en")
    return;
  const auto install = [&](const QString& file, const QString& folder)
  {
    auto texts = std::make_unique<QTranslator>(&application);
    if (texts->load(file, folder))
      QCoreApplication::installTranslator(texts.release());
  };
  install("qtbase_" + code, QLibraryInfo::location(QLibraryInfo::TranslationsPath));
  install(textsOf(code), {});
  useNumberLocale();
}

QString shownLanguage()
{
  //: Code of the language of this file, ISO 639-1
  return QCoreApplication::translate("Language", "en");
}

QLocale numberLocale()
{
  QLocale locale = shownLanguage() == "de" ? QLocale(QLocale::German) : QLocale::c();
  locale.setNumberOptions(QLocale::OmitGroupSeparator | QLocale::RejectGroupSeparator);
  return locale;
}

void useNumberLocale()
{
  QLocale::setDefault(numberLocale());
}

} // namespace petrous::workstation
