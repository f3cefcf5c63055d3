; Installer for Windows: for one person, without the rights of an administrator. scripts/package windows calls makensis with
; VERSION, BINARY (eddy.exe), LICENSES (third-party-licenses.txt) and OUTPUT. /S installs and uninstalls without questions.
Unicode true
ManifestDPIAware true
RequestExecutionLevel user
SetCompressor /SOLID lzma

!include "MUI2.nsh"
!include "FileFunc.nsh"

!define UNINSTALL "Software\Microsoft\Windows\CurrentVersion\Uninstall\Eddy"
!define CLASSES "Software\Classes"

Name "Eddy"
OutFile "${OUTPUT}"
InstallDir "$LOCALAPPDATA\Programs\Eddy"
InstallDirRegKey HKCU "${UNINSTALL}" "InstallLocation"
BrandingText "Eddy ${VERSION}"
VIProductVersion "${VERSION}.0"
VIAddVersionKey "ProductName" "Eddy"
VIAddVersionKey "ProductVersion" "${VERSION}"
VIAddVersionKey "FileVersion" "${VERSION}"
VIAddVersionKey "FileDescription" "Installer of Eddy"
VIAddVersionKey "LegalCopyright" "the Eddy authors"

!define MUI_ICON "..\icon\eddy.ico"
!define MUI_UNICON "..\icon\eddy.ico"
!define MUI_FINISHPAGE_RUN "$INSTDIR\eddy.exe"
!insertmacro MUI_PAGE_LICENSE "..\..\LICENSE-MIT"
!insertmacro MUI_PAGE_DIRECTORY
!insertmacro MUI_PAGE_INSTFILES
!insertmacro MUI_PAGE_FINISH
!insertmacro MUI_UNPAGE_CONFIRM
!insertmacro MUI_UNPAGE_INSTFILES
!insertmacro MUI_LANGUAGE "English"

; "Open with" offers Eddy for files of this ending. What opens them by default stays as it is.
!macro Associate ENDING
    WriteRegStr HKCU "${CLASSES}\${ENDING}\OpenWithProgids" "Eddy.Shader" ""
!macroend
!macro Dissociate ENDING
    DeleteRegValue HKCU "${CLASSES}\${ENDING}\OpenWithProgids" "Eddy.Shader"
!macroend

Section "Eddy"
    SetOutPath "$INSTDIR"
    File "/oname=eddy.exe" "${BINARY}"
    File "..\icon\eddy.ico"
    File "/oname=third-party-licenses.txt" "${LICENSES}"
    File "/oname=LICENSE-MIT.txt" "..\..\LICENSE-MIT"
    File "/oname=LICENSE-APACHE.txt" "..\..\LICENSE-APACHE"
!ifdef DXC
    File "${DXC}\dxcompiler.dll"
    SetOutPath "$INSTDIR\dxcompiler-licenses"
    File "${DXC}\LICENSE*.txt"
    SetOutPath "$INSTDIR"
!endif
    WriteUninstaller "$INSTDIR\uninstall.exe"

    CreateShortcut "$SMPROGRAMS\Eddy.lnk" "$INSTDIR\eddy.exe" "" "$INSTDIR\eddy.ico"
    WriteRegStr HKCU "Software\Microsoft\Windows\CurrentVersion\App Paths\eddy.exe" "" "$INSTDIR\eddy.exe"
    WriteRegStr HKCU "${CLASSES}\Eddy.Shader" "" "Shader"
    WriteRegStr HKCU "${CLASSES}\Eddy.Shader\DefaultIcon" "" "$INSTDIR\eddy.ico"
    WriteRegStr HKCU "${CLASSES}\Eddy.Shader\shell\open\command" "" '"$INSTDIR\eddy.exe" "%1"'
    !insertmacro Associate ".glsl"
    !insertmacro Associate ".frag"
    !insertmacro Associate ".json"
    WriteRegStr HKCU "${CLASSES}\Directory\shell\Eddy" "" "Open with Eddy"
    WriteRegStr HKCU "${CLASSES}\Directory\shell\Eddy" "Icon" "$INSTDIR\eddy.ico"
    WriteRegStr HKCU "${CLASSES}\Directory\shell\Eddy\command" "" '"$INSTDIR\eddy.exe" "%1"'

    WriteRegStr HKCU "${UNINSTALL}" "DisplayName" "Eddy"
    WriteRegStr HKCU "${UNINSTALL}" "DisplayVersion" "${VERSION}"
    WriteRegStr HKCU "${UNINSTALL}" "DisplayIcon" "$INSTDIR\eddy.ico"
    WriteRegStr HKCU "${UNINSTALL}" "Publisher" "the Eddy authors"
    WriteRegStr HKCU "${UNINSTALL}" "InstallLocation" "$INSTDIR"
    WriteRegStr HKCU "${UNINSTALL}" "UninstallString" '"$INSTDIR\uninstall.exe"'
    WriteRegStr HKCU "${UNINSTALL}" "QuietUninstallString" '"$INSTDIR\uninstall.exe" /S'
    WriteRegDWORD HKCU "${UNINSTALL}" "NoModify" 1
    WriteRegDWORD HKCU "${UNINSTALL}" "NoRepair" 1
    ${GetSize} "$INSTDIR" "/S=0K" $0 $1 $2
    WriteRegDWORD HKCU "${UNINSTALL}" "EstimatedSize" $0
SectionEnd

; Settings and recovery files of the person stay.
Section "Uninstall"
    Delete "$INSTDIR\eddy.exe"
    Delete "$INSTDIR\eddy.ico"
    Delete "$INSTDIR\third-party-licenses.txt"
    Delete "$INSTDIR\LICENSE-MIT.txt"
    Delete "$INSTDIR\LICENSE-APACHE.txt"
    Delete "$INSTDIR\dxcompiler.dll"
    Delete "$INSTDIR\dxcompiler-licenses\*.txt"
    RMDir "$INSTDIR\dxcompiler-licenses"
    Delete "$INSTDIR\uninstall.exe"
    RMDir "$INSTDIR"
    Delete "$SMPROGRAMS\Eddy.lnk"
    DeleteRegKey HKCU "Software\Microsoft\Windows\CurrentVersion\App Paths\eddy.exe"
    DeleteRegKey HKCU "${CLASSES}\Eddy.Shader"
    !insertmacro Dissociate ".glsl"
    !insertmacro Dissociate ".frag"
    !insertmacro Dissociate ".json"
    DeleteRegKey HKCU "${CLASSES}\Directory\shell\Eddy"
    DeleteRegKey HKCU "${UNINSTALL}"
SectionEnd
