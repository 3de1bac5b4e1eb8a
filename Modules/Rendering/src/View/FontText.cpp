#include "FontText.h"

#include <unicode/normalizer2.h>
#include <unicode/uchar.h>
#include <unicode/unistr.h>

#include <vtkFreeTypeTools.h>
#include <vtkPath.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

namespace petrous::rendering
{

namespace
{

constexpr int kDpi = 72;
constexpr char16_t kUnknown = u'?'; // the fonts lack U+FFFD

bool hasGlyph(vtkTextProperty* style, UChar32 character)
{
  const auto outline = vtkFreeTypeTools::GetInstance()->GetUnscaledGlyphOutline(
      style, static_cast<vtkUnicodeStringValueType>(character));
  return outline.Path && outline.Path->GetNumberOfPoints() > 0;
}

std::string drawable(vtkTextProperty* style, const std::string& text)
{
  auto unicode = icu::UnicodeString::fromUTF8(text); // what is not UTF-8 becomes U+FFFD
  UErrorCode error = U_ZERO_ERROR;
  if (const auto* const composed = icu::Normalizer2::getNFCInstance(error); U_SUCCESS(error))
    if (const auto whole = composed->normalize(unicode, error); U_SUCCESS(error))
      unicode = whole;
  icu::UnicodeString drawn;
  for (std::int32_t at = 0; at < unicode.length(); at = unicode.moveIndex32(at, 1))
  {
    const UChar32 character = unicode.char32At(at);
    if (u_isUWhiteSpace(character))
      drawn += u' ';
    else if (hasGlyph(style, character))
      drawn += character;
    else if (!u_hasBinaryProperty(character, UCHAR_DEFAULT_IGNORABLE_CODE_POINT))
      drawn += kUnknown;
  }
  std::string bytes;
  return drawn.toUTF8String(bytes);
}

} // namespace

bool drawText(vtkTextProperty* style, const std::string& text, vtkImageData* image, int size[2])
{
  vtkTextRenderer* renderer = vtkTextRenderer::GetInstance();
  const std::string drawn = drawable(style, text);
  // No MathText: a '$' is a '$'.
  return renderer && !drawn.empty() &&
         renderer->RenderString(style, vtkStdString(drawn), image, size, kDpi,
                                vtkTextRenderer::FreeType);
}

} // namespace petrous::rendering
