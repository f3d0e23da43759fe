; The installer for Windows: for one user, without an administrator, over an older version in place.
; makensis -DVERSION=0.1.0 -DPAYLOAD=folder -DOUTPUT=Carpus-0.1.0-setup.exe carpus.nsi
; Patients' data lie in the user's data folder, which nothing here touches.
Unicode true
ManifestDPIAware true
ManifestLongPathAware true
RequestExecutionLevel user
SetCompressor /SOLID lzma
!include "MUI2.nsh"
!include "FileFunc.nsh"
!include "LogicLib.nsh"

!define UNINSTALL "Software\Microsoft\Windows\CurrentVersion\Uninstall\Carpus"
!define FILE_KIND "Carpus.Session"

Name "Carpus"
OutFile "${OUTPUT}"
InstallDir "$LOCALAPPDATA\Programs\Carpus"
InstallDirRegKey HKCU "Software\Carpus" "InstallFolder"
BrandingText "Carpus ${VERSION}"
VIProductVersion "${VERSION4}"
VIAddVersionKey "ProductName" "Carpus"
VIAddVersionKey "ProductVersion" "${VERSION}"
VIAddVersionKey "FileVersion" "${VERSION}"
VIAddVersionKey "FileDescription" "Sets up Carpus"
VIAddVersionKey "CompanyName" "The Carpus developers"
VIAddVersionKey "LegalCopyright" "MIT licence"

!insertmacro MUI_PAGE_WELCOME
!insertmacro MUI_PAGE_LICENSE "${LICENCE}"
!insertmacro MUI_PAGE_DIRECTORY
!insertmacro MUI_PAGE_INSTFILES
!define MUI_FINISHPAGE_RUN "$INSTDIR\Carpus-window.exe"
!insertmacro MUI_PAGE_FINISH
!insertmacro MUI_UNPAGE_CONFIRM
!insertmacro MUI_UNPAGE_INSTFILES
!insertmacro MUI_LANGUAGE "English"
!insertmacro MUI_LANGUAGE "German"

LangString RUNNING ${LANG_ENGLISH} "Carpus is open. Close it, then go on."
LangString RUNNING ${LANG_GERMAN} "Carpus ist geöffnet. Bitte schließen, dann weiter."

; Windows keeps the files of a running program: opening one for writing tells. A silent run ends with 3 instead of asking.
!macro WAIT_UNTIL_CLOSED
  again:
  ${If} ${FileExists} "$INSTDIR\Carpus-window.exe"
    ClearErrors
    FileOpen $0 "$INSTDIR\Carpus-window.exe" a
    ${If} ${Errors}
      IfSilent 0 +3
        SetErrorLevel 3
        Abort
      MessageBox MB_RETRYCANCEL|MB_ICONEXCLAMATION "$(RUNNING)" IDRETRY again
      Abort
    ${EndIf}
    FileClose $0
  ${EndIf}
!macroend

; Only what this program put there: whatever else a person keeps in the folder stays.
!macro REMOVE_PROGRAM
  RMDir /r "$INSTDIR\parts"
  Delete "$INSTDIR\carpus.exe"
  Delete "$INSTDIR\Carpus-window.exe"
  Delete "$INSTDIR\licences.txt"
  Delete "$INSTDIR\parts.cdx.json"
!macroend

Section "Carpus"
  !insertmacro WAIT_UNTIL_CLOSED
  !insertmacro REMOVE_PROGRAM
  SetOutPath "$INSTDIR"
  File /r "${PAYLOAD}/*"
  WriteUninstaller "$INSTDIR\uninstall.exe"
  CreateShortcut "$SMPROGRAMS\Carpus.lnk" "$INSTDIR\Carpus-window.exe"
  WriteRegStr HKCU "Software\Carpus" "InstallFolder" "$INSTDIR"
  WriteRegStr HKCU "Software\Classes\${FILE_KIND}" "" "Carpus session"
  WriteRegStr HKCU "Software\Classes\${FILE_KIND}\DefaultIcon" "" "$INSTDIR\Carpus-window.exe,0"
  WriteRegStr HKCU "Software\Classes\${FILE_KIND}\shell\open\command" "" '"$INSTDIR\Carpus-window.exe" review "%1"'
  ; Other programs' files end in .h5 too: Carpus stands under "Open with" and becomes nobody's default unasked.
  WriteRegStr HKCU "Software\Classes\.h5\OpenWithProgids" "${FILE_KIND}" ""
  WriteRegStr HKCU "${UNINSTALL}" "DisplayName" "Carpus"
  WriteRegStr HKCU "${UNINSTALL}" "DisplayVersion" "${VERSION}"
  WriteRegStr HKCU "${UNINSTALL}" "Publisher" "The Carpus developers"
  WriteRegStr HKCU "${UNINSTALL}" "DisplayIcon" "$INSTDIR\Carpus-window.exe"
  WriteRegStr HKCU "${UNINSTALL}" "InstallLocation" "$INSTDIR"
  WriteRegStr HKCU "${UNINSTALL}" "UninstallString" '"$INSTDIR\uninstall.exe"'
  WriteRegStr HKCU "${UNINSTALL}" "QuietUninstallString" '"$INSTDIR\uninstall.exe" /S'
  WriteRegDWORD HKCU "${UNINSTALL}" "NoModify" 1
  WriteRegDWORD HKCU "${UNINSTALL}" "NoRepair" 1
  ${GetSize} "$INSTDIR" "/S=0K" $0 $1 $2
  WriteRegDWORD HKCU "${UNINSTALL}" "EstimatedSize" $0
  System::Call 'shell32::SHChangeNotify(i 0x08000000, i 0, p 0, p 0)'
SectionEnd

Section "un.Carpus"
  !insertmacro WAIT_UNTIL_CLOSED
  !insertmacro REMOVE_PROGRAM
  Delete "$INSTDIR\uninstall.exe"
  RMDir "$INSTDIR"
  Delete "$SMPROGRAMS\Carpus.lnk"
  DeleteRegKey HKCU "${UNINSTALL}"
  DeleteRegKey HKCU "Software\Carpus"
  DeleteRegKey HKCU "Software\Classes\${FILE_KIND}"
  DeleteRegValue HKCU "Software\Classes\.h5\OpenWithProgids" "${FILE_KIND}"
  System::Call 'shell32::SHChangeNotify(i 0x08000000, i 0, p 0, p 0)'
SectionEnd
